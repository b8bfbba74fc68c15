// Grids: places, springs, lengths and surface as the scene's documentation says, against counts and brute
// force.
#include "tests/scene/scene_makers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gmock/gmock.h>
#include <map>

namespace hopmesh::tests {
namespace {

using namespace scene;

Scene with_springs(Scene scene, double structural, double shear, double bend) {
  scene.mesh.structural = structural;
  scene.mesh.shear = shear;
  scene.mesh.bend = bend;
  return scene;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Every pair of nodes, asked what joins it: slow, and nothing like the code it judges.
std::map<Pair, double> springs_by_asking(const Scene& scene) {
  std::map<Pair, double> springs;
  const int columns = scene.mesh.grid->columns, nodes = scene.mesh.grid->rows * columns;
  for (int a = 0; a < nodes; ++a)
    for (int b = a + 1; b < nodes; ++b) {
      const int down = std::abs(b / columns - a / columns), right = std::abs(b % columns - a % columns);
      double weight = 0;
      if (down + right == 1)
        weight = scene.mesh.structural;
      else if (down == 1 && right == 1)
        weight = scene.mesh.shear;
      else if ((down == 2 && right == 0) || (down == 0 && right == 2))
        weight = scene.mesh.bend;
      if (weight > 0) springs[{a, b}] = weight;
    }
  return springs;
}

std::map<Pair, double> springs_of(const Mesh& mesh) {
  std::map<Pair, double> springs;
  for (const Spring& s : mesh.springs) springs[{s.node[0], s.node[1]}] = s.weight;
  return springs;
}

TEST(Grid, nodesHangFromTheOriginInRows) {
  const Mesh mesh = build_mesh(grid_scene(3, 4, 0.5));
  ASSERT_EQ(mesh.nodes(), 12u);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) EXPECT_EQ(mesh.position[r * 4 + c], (Vector3{c * 0.5, 0, -r * 0.5}));
}

TEST(Grid, springsAreThoseOfTheDefinition) {
  for (int rows = 1; rows <= 5; ++rows)
    for (int columns = rows == 1 ? 2 : 1; columns <= 5; ++columns) {
      const Scene scene = with_springs(grid_scene(rows, columns), 1, 0.5, 0.25);
      EXPECT_EQ(springs_of(build_mesh(scene)), springs_by_asking(scene)) << rows << " x " << columns;
    }
}

TEST(Grid, springsOfNoWeightDoNotExist) {
  EXPECT_EQ(build_mesh(with_springs(grid_scene(3, 4), 1, 0, 0)).springs.size(), 3u * 3 + 2 * 4);
  EXPECT_EQ(build_mesh(with_springs(grid_scene(3, 4), 0, 1, 0)).springs.size(), 2u * 2 * 3);
  EXPECT_EQ(build_mesh(with_springs(grid_scene(4, 4), 0, 0, 1)).springs.size(), 2u * 4 * 2);
  EXPECT_EQ(build_mesh(grid_scene(20, 20)).springs.size(), 2u * 20 * 19 + 2 * 19 * 19);
}

TEST(Grid, springsAscendAndJoinEachPairOnce) {
  const Mesh mesh = build_mesh(with_springs(grid_scene(7, 6), 1, 1, 1));
  for (std::size_t k = 0; k < mesh.springs.size(); ++k) {
    const Spring& s = mesh.springs[k];
    EXPECT_LT(s.node[0], s.node[1]);
    if (k == 0) continue;
    const Spring& before = mesh.springs[k - 1];
    EXPECT_LT(std::make_pair(before.node[0], before.node[1]), std::make_pair(s.node[0], s.node[1]));
  }
}

TEST(Grid, restLengthsAreNaturalUnlessGiven) {
  Scene scene = with_springs(grid_scene(3, 3, 2.0), 1, 2, 3); // a weight of its own tells the kinds apart
  for (const Spring& s : build_mesh(scene).springs)
    EXPECT_EQ(s.rest_length, s.weight == 1 ? 2.0 : s.weight == 2 ? std::sqrt(8.0) : 4.0);
  scene.mesh.rest = 0.0;
  for (const Spring& s : build_mesh(scene).springs) EXPECT_EQ(s.rest_length, 0.0);
  scene.mesh.rest = 1.25;
  for (const Spring& s : build_mesh(scene).springs) EXPECT_EQ(s.rest_length, 1.25);
}

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

TEST(Grid, surfaceFacesTheViewerAtMinusY) {
  const Mesh mesh = build_mesh(grid_scene(4, 3));
  EXPECT_EQ(mesh.triangles.size(), 2u * 3 * 2);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = minus(mesh.position[t[1].node], mesh.position[t[0].node]);
    const Vector3 b = minus(mesh.position[t[2].node], mesh.position[t[0].node]);
    const double y = a[2] * b[0] - a[0] * b[2]; // of the cross product
    EXPECT_LT(y, 0);
    area -= y / 2;
  }
  EXPECT_EQ(area, 3.0 * 2.0); // covered once, without holes
}

TEST(Grid, pictureStartsAtTheTopLeft) {
  const Mesh mesh = build_mesh(grid_scene(5, 3));
  for (const auto& triangle : mesh.triangles)
    for (const Corner& corner : triangle) {
      EXPECT_EQ(corner.u, float(corner.node % 3) / 2);
      EXPECT_EQ(corner.v, float(corner.node / 3) / 4);
    }
}

TEST(Grid, aRopeHasNoSurface) {
  const Mesh mesh = build_mesh(grid_scene(1, 5));
  EXPECT_EQ(mesh.springs.size(), 4u);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Grid, carriesMassAndPlanar) {
  Scene scene = grid_scene(2, 2);
  scene.mesh.mass = 0.25;
  scene.mesh.planar = true;
  const Mesh mesh = build_mesh(scene);
  EXPECT_EQ(mesh.mass, 0.25);
  EXPECT_TRUE(mesh.planar);
}

TEST(Grid, ofAMillionNodesBuildsInSeconds) {
  const auto start = std::chrono::steady_clock::now();
  const Mesh mesh = build_mesh(with_springs(grid_scene(1000, 1000), 1, 1, 1));
  EXPECT_EQ(mesh.nodes(), 1000000u);
  EXPECT_EQ(mesh.springs.size(), 2u * 1000 * 999 + 2 * 999 * 999 + 2 * 1000 * 998);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10.0);
}

TEST(Grid, refusesSizesThatNoFileCouldAskFor) {
  EXPECT_THAT(complaint([] { build_mesh(grid_scene(0, 5)); }), ::testing::HasSubstr("found 0 x 5 nodes"));
  EXPECT_THAT(complaint([] { build_mesh(grid_scene(1, 1)); }), ::testing::HasSubstr("found 1 x 1 nodes"));
  EXPECT_THAT(complaint([] { build_mesh(grid_scene(2001, 2000)); }),
              ::testing::HasSubstr("2 to 4000000 nodes"));
}

} // namespace
} // namespace hopmesh::tests
