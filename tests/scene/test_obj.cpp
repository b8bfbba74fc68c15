// Meshes from OBJ files: corners in all forms, polygons, edges as springs. Broken files are in bad/*.obj.
#include "tests/scene/scene_makers.h"

#include <chrono>
#include <cmath>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;

std::vector<std::pair<int, int>> edges(const Mesh& mesh) {
  std::vector<std::pair<int, int>> all;
  for (const Spring& s : mesh.springs) all.emplace_back(s.node[0], s.node[1]);
  return all;
}

std::vector<std::array<std::uint32_t, 3>> triangles(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> all;
  for (const auto& t : mesh.triangles) all.push_back({t[0].node, t[1].node, t[2].node});
  return all;
}

using Triangle = std::array<std::uint32_t, 3>;

TEST(Obj, readsEveryFormOfCornerAndIgnoresTheRest) {
  const Mesh mesh = build_mesh(file_scene(folder + "good/square.obj"));
  EXPECT_THAT(mesh.position,
              ElementsAre(Vector3{0, 0, 0}, Vector3{1, 0, 0}, Vector3{1, 0, 1}, Vector3{0, 0, 1}));
  EXPECT_THAT(triangles(mesh), ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Obj, polygonsAreFansButOnlyTheirSidesAreSprings) {
  const Mesh mesh = mesh_of_obj("v 0 0 0\nv 2 0 0\nv 3 0 1\nv 1 0 3\nv -1 0 1\nf 1 2 3 4 5\n");
  EXPECT_THAT(triangles(mesh), ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
  EXPECT_THAT(edges(mesh), ElementsAre(std::pair{0, 1}, std::pair{0, 4}, std::pair{1, 2}, std::pair{2, 3},
                                       std::pair{3, 4}));
}

TEST(Obj, linesAreSpringsFromPointToPoint) {
  const Mesh mesh = mesh_of_obj("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nl 1 2 3\nl 4/1 2\nvt 0 0\n");
  EXPECT_THAT(edges(mesh), ElementsAre(std::pair{0, 1}, std::pair{1, 2}, std::pair{1, 3}));
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Obj, aLineAlongAFaceIsNoSecondSpring) {
  const Mesh mesh = mesh_of_obj("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 0 2\nf 1 2 3\nl 4 3 1\n");
  EXPECT_THAT(edges(mesh), ElementsAre(std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}, std::pair{2, 3}));
}

TEST(Obj, theFloorOfATensionIsAThousandthOfTheMeanSpringUnlessTold) {
  const Folder temp;
  Scene scene = file_scene(temp.write("l.obj", "v 0 0 0\nv 1 0 0\nv 1 0 3\nl 1 2 3\n"));
  scene.mesh.law = SpringLaw::tension;
  EXPECT_DOUBLE_EQ(build_mesh(scene).floor, 2e-3);
  EXPECT_EQ(build_mesh(scene).springs[1].rest_length, 0);
  scene.mesh.floor = 0.5;
  EXPECT_EQ(build_mesh(scene).floor, 0.5);
}

TEST(Obj, sharedEdgesAreOneSpring) {
  const Mesh mesh = build_mesh(file_scene(folder + "good/tent.obj"));
  EXPECT_THAT(edges(mesh), ElementsAre(std::pair{0, 1}, std::pair{0, 3}, std::pair{0, 4}, std::pair{1, 2},
                                       std::pair{1, 4}, std::pair{2, 3}, std::pair{2, 4}, std::pair{3, 4}));
}

TEST(Obj, pictureCornersAreTurnedUpsideDown) {
  const Mesh mesh = build_mesh(file_scene(folder + "good/square.obj"));
  const auto& first = mesh.triangles[0];
  EXPECT_EQ(first[0].u, 0); // vt 0 0 is the bottom left in OBJ, (0, 1) in a picture
  EXPECT_EQ(first[0].v, 1);
  EXPECT_EQ(first[2].u, 1); // vt 1 1: the top right
  EXPECT_EQ(first[2].v, 0);
}

TEST(Obj, negativeIndicesCountBackFromWhereTheyStand) {
  const Mesh mesh = mesh_of_obj("v 0 0 0\nv 1 0 0\nv 0 0 1\nf -3 -2 -1\nv 1 0 1\nf -1 -2 -3\n");
  EXPECT_THAT(triangles(mesh), ElementsAre(Triangle{0, 1, 2}, Triangle{3, 2, 1}));
}

TEST(Obj, facesMayStandBeforeTheirVertices) {
  const Mesh mesh = mesh_of_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 0 1\n");
  EXPECT_EQ(mesh.springs.size(), 3u);
}

TEST(Obj, theLastLineNeedsNoEnd) {
  EXPECT_EQ(mesh_of_obj("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3").triangles.size(), 1u);
}

TEST(Obj, scaleAndRestSetTheLengths) {
  Scene scene = file_scene(folder + "good/tent.obj");
  scene.mesh.scale = 3;
  scene.mesh.structural = 0.5;
  const Mesh mesh = build_mesh(scene);
  EXPECT_EQ(mesh.position[4], (Vector3{3, 3, 3}));
  EXPECT_EQ(mesh.springs[0].rest_length, 6.0);             // a side of the floor
  EXPECT_EQ(mesh.springs[2].rest_length, std::sqrt(27.0)); // to the peak
  for (const Spring& s : mesh.springs) EXPECT_EQ(s.weight, 0.5);
  scene.mesh.rest = 1.5;
  for (const Spring& s : build_mesh(scene).springs) EXPECT_EQ(s.rest_length, 1.5);
}

TEST(Obj, aFlatMeshMayBePlanar) {
  Scene scene = file_scene(folder + "good/square.obj");
  scene.mesh.planar = true;
  EXPECT_TRUE(build_mesh(scene).planar);
}

TEST(Obj, withoutSpringsIsRefused) {
  Scene scene = file_scene(folder + "good/square.obj");
  scene.mesh.structural = 0;
  EXPECT_THAT(complaint([&] { build_mesh(scene); }), ::testing::HasSubstr("found no spring"));
}

std::string sheet(int n) {
  std::string text;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) text += "v " + std::to_string(c) + " 0 " + std::to_string(r) + '\n';
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const int k = r * n + c + 1;
      for (int corner : {k, k + 1, k + n + 1, k + n})
        text += (corner == k ? "f " : " ") + std::to_string(corner);
      text += '\n';
    }
  return text;
}

TEST(Obj, ofThousandsOfNodesReadsInMilliseconds) {
  const std::string text = sheet(55);
  const auto start = std::chrono::steady_clock::now();
  const Mesh mesh = mesh_of_obj(text);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(mesh.nodes(), 3025u);
  EXPECT_EQ(mesh.springs.size(), 2u * 55 * 54);
  EXPECT_LT(seconds, 0.25); // some 3 ms; room for a slow machine and for sanitizers
}

} // namespace
} // namespace hopmesh::tests
