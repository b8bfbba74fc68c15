// mesh.start: random places that are the same everywhere.
#include "tests/scene/scene_makers.h"

#include <cmath>
#include <set>

namespace hopmesh::tests {
namespace {

using namespace scene;

Scene shuffled(int rows, int columns, double shuffle, std::int64_t seed) {
  Scene scene = grid_scene(rows, columns);
  scene.mesh.start = {shuffle, seed};
  return scene;
}

/// The first numbers of SplitMix64 with seed 1234567, as its authors' code prints them.
TEST(Shuffle, followsThePublishedGenerator) {
  const std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                     4593380528125082431u, 16408922859458223821u};
  const Mesh mesh = build_mesh(shuffled(1, 2, 0.5, 1234567));
  for (std::size_t k = 0; k < 5; ++k) {
    const double share = std::ldexp(static_cast<double>(published[k] >> 11), -52) - 1;
    EXPECT_EQ(mesh.position[k / 3][k % 3], (k == 3 ? 1.0 : 0.0) + 0.5 * share) << k; // node 1 stands at x = 1
  }
}

TEST(Shuffle, staysWithinItsBoundAndFillsIt) {
  const Mesh built = build_mesh(grid_scene(20, 20)), mesh = build_mesh(shuffled(20, 20, 0.25, 3));
  double sum = 0, least = 1, largest = -1;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t p = 0; p < 3; ++p) {
      const double way = (mesh.position[i][p] - built.position[i][p]) / 0.25;
      sum += way, least = std::min(least, way), largest = std::max(largest, way);
    }
  EXPECT_GE(least, -1 - 1e-12);
  EXPECT_LT(least, -0.98);
  EXPECT_LE(largest, 1 + 1e-12);
  EXPECT_GT(largest, 0.98);
  EXPECT_LT(std::fabs(sum / 1200), 4 / std::sqrt(3 * 1200.0)); // four deviations of a mean of 1,200
}

TEST(Shuffle, leavesPinsAndRestLengths) {
  Scene scene = shuffled(4, 5, 0.4, 1);
  const Mesh free = build_mesh(scene);
  scene.mesh.pinned = {std::string("left")};
  const Mesh mesh = build_mesh(scene), built = build_mesh(grid_scene(4, 5));
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    EXPECT_EQ(mesh.position[i], (mesh.pinned[i] ? built : free).position[i]) << i;
  for (std::size_t s = 0; s < mesh.springs.size(); ++s)
    EXPECT_EQ(mesh.springs[s].rest_length, built.springs[s].rest_length);
}

TEST(Shuffle, keepsPlanarMeshesInTheirPlane) {
  Scene scene = shuffled(3, 3, 0.4, 1);
  scene.mesh.planar = true;
  for (const Vector3& x : build_mesh(scene).position) EXPECT_EQ(x[1], 0);
}

TEST(Shuffle, seedsDiffer) {
  std::set<double> places;
  for (std::int64_t seed = 0; seed < 50; ++seed)
    places.insert(build_mesh(shuffled(1, 2, 1, seed)).position[0][0]);
  EXPECT_EQ(places.size(), 50u);
}

} // namespace
} // namespace hopmesh::tests
