// Which nodes a pin holds, on grids and on meshes from files.
#include "tests/scene/scene_makers.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;

std::vector<std::size_t> held(Scene scene, const std::vector<Pin>& pins) {
  scene.mesh.pinned = pins;
  const Mesh mesh = build_mesh(scene);
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.pinned[i]) nodes.push_back(i);
  return nodes;
}

//  0  1  2  3
//  4  5  6  7
//  8  9 10 11
const Scene pin_grid = grid_scene(3, 4);

TEST(Pins, sidesOfAGrid) {
  EXPECT_THAT(held(pin_grid, {"left"}), ElementsAre(0, 4, 8));
  EXPECT_THAT(held(pin_grid, {"right"}), ElementsAre(3, 7, 11));
  EXPECT_THAT(held(pin_grid, {"top"}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(held(pin_grid, {"bottom"}), ElementsAre(8, 9, 10, 11));
  EXPECT_THAT(held(pin_grid, {"corners"}), ElementsAre(0, 3, 8, 11));
  EXPECT_TRUE(held(pin_grid, {}).empty());
}

TEST(Pins, addUp) {
  EXPECT_THAT(held(pin_grid, {"left", "corners"}), ElementsAre(0, 3, 4, 8, 11));
  EXPECT_THAT(held(pin_grid, {std::int64_t{5}, "left", std::int64_t{0}, std::int64_t{5}}),
              ElementsAre(0, 4, 5, 8));
  EXPECT_THAT(held(pin_grid, {std::int64_t{11}}), ElementsAre(11));
}

TEST(Pins, mustNameNodesOfTheMesh) {
  EXPECT_THAT(complaint([] { held(pin_grid, {std::int64_t{12}}); }),
              ::testing::HasSubstr("found node 12, expected node numbers from 0 to 11"));
  EXPECT_THAT(complaint([] { held(pin_grid, {std::int64_t{-1}}); }), ::testing::HasSubstr("found node -1"));
  EXPECT_THAT(complaint([] { held(pin_grid, {"lefd"}); }), ::testing::HasSubstr("(did you mean left?)"));
}

std::vector<std::size_t> held_inside(Scene scene, const Vector3& centre, double radius,
                                     const std::vector<Pin>& pins = {}) {
  scene.mesh.pin_ball = PinBall{centre, radius};
  return held(scene, pins);
}

TEST(Pins, aBallHoldsWhatLiesInside) {
  EXPECT_THAT(held_inside(pin_grid, {1, 0, -1}, 0.5), ElementsAre(5));
  EXPECT_THAT(held_inside(pin_grid, {1, 0, -1}, 1), ElementsAre(1, 4, 5, 6, 9)); // its skin counts
  EXPECT_THAT(held_inside(pin_grid, {1, 0, -1}, 1.4), ElementsAre(1, 4, 5, 6, 9));
  EXPECT_THAT(held_inside(pin_grid, {1.5, 0.5, -2}, 0.71), ElementsAre(9, 10)); // from beside the pin_grid
  EXPECT_THAT(held_inside(pin_grid, {3, 0, 0}, 0.1, {"left"}), ElementsAre(0, 3, 4, 8));
}

TEST(Pins, aBallMustHoldANode) {
  EXPECT_THAT(
      complaint([] {
        held_inside(pin_grid, {0.5, 0, -0.5}, 0.7);
      }),
      ::testing::HasSubstr("mesh.pin_ball: found no node inside, expected at least one node within 0.7 m"));
}

TEST(Pins, mustLeaveANodeFree) {
  EXPECT_THAT(complaint([] {
                held(grid_scene(2, 5), {"top", "bottom"});
              }),
              ::testing::HasSubstr("found all 10 nodes pinned"));
}

// Two rows that nothing joins: one with a pin, one without.
TEST(Pins, aStaticSceneNeedsOneInEveryPartOfTheMesh) {
  Scene scene = file_scene("");
  const Folder temp;
  scene.mesh.file = temp.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 0 1\n"
                                          "f 1 2 3\nf 4 5 6\n");
  scene.mesh.pinned.emplace_back(std::int64_t{1});
  scene.motion.formulation = Formulation::incremental;
  EXPECT_EQ(complaint([&] { build_mesh(scene); }), "");
  scene.incremental.rule = Rule::statics;
  EXPECT_THAT(complaint([&] { build_mesh(scene); }),
              ::testing::HasSubstr("mesh.pinned: found no pin in the part of node 3"));
  scene.mesh.pinned.emplace_back(std::int64_t{5});
  EXPECT_EQ(complaint([&] { build_mesh(scene); }), "");
}

/// Vertices 0..4 at (0,0,0) (2,0,0) (2,0,2) (0,0,2) and the peak (1,1,1).
Scene tent(Axis up, double band) {
  Scene scene = file_scene(folder + "good/tent.obj");
  scene.mesh.up = up;
  scene.mesh.pin_band = band;
  return scene;
}

TEST(Pins, topAndBottomOfAFileMeshFollowItsUpAxis) {
  EXPECT_THAT(held(tent(Axis::y, 0.02), {"top"}), ElementsAre(4));
  EXPECT_THAT(held(tent(Axis::y, 0.02), {"bottom"}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(held(tent(Axis::z, 0.02), {"top"}), ElementsAre(2, 3));
  EXPECT_THAT(held(tent(Axis::z, 0.02), {"bottom"}), ElementsAre(0, 1));
  EXPECT_THAT(held(tent(Axis::x, 0.02), {"top"}), ElementsAre(1, 2));
}

TEST(Pins, leftAndRightOfAFileMeshAreAlongXUnlessThatIsUp) {
  EXPECT_THAT(held(tent(Axis::z, 0.02), {"left"}), ElementsAre(0, 3));
  EXPECT_THAT(held(tent(Axis::y, 0.02), {"right"}), ElementsAre(1, 2));
  EXPECT_THAT(held(tent(Axis::x, 0.02), {"right"}), ElementsAre(4)); // along y
}

TEST(Pins, theBandIsAShareOfTheExtent) {
  EXPECT_THAT(held(tent(Axis::z, 0.499), {"top"}), ElementsAre(2, 3));
  EXPECT_THAT(held(tent(Axis::z, 0.5), {"top"}),
              ElementsAre(2, 3, 4)); // the peak at half the extent: just within
  EXPECT_THAT(held(tent(Axis::z, 0.0), {"top"}), ElementsAre(2, 3)); // the highest always
}

TEST(Pins, theBandGrowsWithTheScale) {
  Scene scene = tent(Axis::z, 0.5);
  scene.mesh.scale = 100;
  EXPECT_THAT(held(scene, {"top"}), ElementsAre(2, 3, 4));
}

} // namespace
} // namespace hopmesh::tests
