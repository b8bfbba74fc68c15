// A scene's mesh as the array and the firmware see it.
#include "sim/levels/reference_check.h"
#include "tests/support/small_scenes.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>
#include <set>

namespace hopmesh::tests {
namespace {

using ::testing::ElementsAre;

// 2 x 3: free are 1, 2 and 4, 5 of
//   0 1 2
//   3 4 5
TEST(BuiltMesh, CellsAreTheFreeNodesAscending) {
  const levels::BuiltMesh mesh(grid_scene(2, 3));
  EXPECT_EQ(mesh.nodes(), 6u);
  ASSERT_EQ(mesh.cells(), 4u);
  EXPECT_EQ(mesh.components(), 3u);
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_EQ(mesh.node_of_cell(c), (std::vector<std::uint32_t>{1, 2, 4, 5})[c]);
  for (std::size_t node : {0, 3}) EXPECT_EQ(mesh.firmware().cell_of_node[node], HM_PINNED);
  EXPECT_EQ(mesh.firmware().cell_of_node[4], 2u);
}

TEST(BuiltMesh, LinksJoinFreeNeighboursOnly) {
  const levels::BuiltMesh mesh(grid_scene(2, 3));
  EXPECT_THAT(mesh.topology().first_link, ElementsAre(0, 3, 6, 9, 12)); // 4 cells, each joined to all others
  EXPECT_THAT(mesh.topology().link_to, ElementsAre(1, 2, 3, 0, 2, 3, 0, 1, 3, 0, 1, 2));
  EXPECT_EQ(mesh.topology().links(), 6u);
}

TEST(BuiltMesh, EveryWeightHasOnePlaceAndItsTransposeAnother) {
  const levels::BuiltMesh mesh(grid_scene(3, 4));
  std::set<std::size_t> places;
  std::set<std::pair<std::uint32_t, std::uint32_t>> entries;
  mesh.each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    EXPECT_TRUE(places.insert(place).second && entries.emplace(row, column).second);
  });
  EXPECT_EQ(places.size(), mesh.topology().weight_words());
  EXPECT_EQ(*places.rbegin() + 1, places.size());
  for (const auto& [row, column] : entries) EXPECT_EQ(entries.count({column, row}), 1u);
}

TEST(BuiltMesh, ByCellTakesBackWhatByNodeSpread) {
  const levels::BuiltMesh mesh(grid_scene(2, 3));
  std::vector<double> of_cells(12);
  std::iota(of_cells.begin(), of_cells.end(), 1.0);
  EXPECT_EQ(mesh.by_cell(mesh.by_node(of_cells)), of_cells);
}

TEST(BuiltMesh, LinksAreSymmetricAndSortedInALargerOne) {
  scene::Scene scene = grid_scene(5, 7);
  scene.mesh.bend = 0.5;
  const levels::BuiltMesh mesh(scene);
  const spec::Topology& t = mesh.topology();
  const auto row = [&](std::uint32_t c) {
    return std::vector<std::uint32_t>(t.link_to.begin() + t.first_link[c],
                                      t.link_to.begin() + t.first_link[c + 1]);
  };
  for (std::uint32_t c = 0; c < t.cells(); ++c) {
    const auto links = row(c);
    EXPECT_TRUE(std::is_sorted(links.begin(), links.end()));
    EXPECT_EQ(std::adjacent_find(links.begin(), links.end()), links.end());
    for (std::uint32_t other : links) {
      EXPECT_NE(other, c);
      const auto back = row(other);
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), c)) << c << ' ' << other;
    }
  }
}

TEST(BuiltMesh, EverySpringBetweenFreeNodesFoundItsLinks) {
  const levels::BuiltMesh mesh(grid_scene(4, 4));
  const hm_mesh& f = mesh.firmware();
  for (std::uint32_t s = 0; s < f.springs; ++s) {
    const std::uint32_t a = f.cell_of_node[f.spring[s].node[0]], b = f.cell_of_node[f.spring[s].node[1]];
    if (a == HM_PINNED || b == HM_PINNED) continue;
    EXPECT_EQ(f.link_to[f.spring[s].link[0]], b);
    EXPECT_EQ(f.link_to[f.spring[s].link[1]], a);
  }
}

TEST(BuiltMesh, BetaWeightIsTheMeanAlphaOfANodesSprings) {
  scene::Scene scene = grid_scene(2, 3);
  scene.mesh.structural = 2;
  scene.mesh.shear = 0.5;
  const levels::BuiltMesh mesh(scene);
  EXPECT_DOUBLE_EQ(mesh.firmware().beta_weight[0], (2 + 2 + 0.5) / 3); // right, down, diagonal
  EXPECT_DOUBLE_EQ(mesh.firmware().beta_weight[1],
                   (3 * 2 + 2 * 0.5) / 5.0); // left, right, down, both diagonals
}

TEST(BuiltMesh, PlanarMeshesHaveTwoNeuronsAlongXAndZ) {
  scene::Scene scene = grid_scene(2, 3);
  scene.mesh.planar = true;
  const levels::BuiltMesh mesh(scene);
  EXPECT_EQ(mesh.components(), 2u);
  EXPECT_EQ(mesh.topology().neurons(), 8u);
  EXPECT_EQ(mesh.firmware().axis[0], 0u);
  EXPECT_EQ(mesh.firmware().axis[1], 2u);
}

TEST(BuiltMesh, ByNodePutsZerosAtPinnedNodes) {
  const levels::BuiltMesh mesh(grid_scene(1, 3));
  EXPECT_THAT(mesh.by_node(std::vector<int>{1, 2, 3, 4, 5, 6}), ElementsAre(0, 0, 0, 1, 2, 3, 4, 5, 6));
}

TEST(OrderFor, MapsCellsToNodes) {
  scene::Scene scene = grid_scene(1, 3); // nodes 1 and 2 are cells 0 and 1, joined: two colours
  const levels::BuiltMesh mesh(scene);
  using Phase = std::vector<std::uint32_t>;
  EXPECT_THAT(levels::order_for(mesh, spec::Schedule::sequential),
              ElementsAre(Phase{3}, Phase{4}, Phase{5}, Phase{6}, Phase{7}, Phase{8}));
  EXPECT_THAT(levels::order_for(mesh, spec::Schedule::synchronous), ElementsAre(Phase{3, 4, 5, 6, 7, 8}));
  EXPECT_THAT(levels::order_for(mesh, spec::Schedule::coloured),
              ElementsAre(Phase{3}, Phase{4}, Phase{5}, Phase{6}, Phase{7}, Phase{8}));
}

TEST(OrderFor, PlanarNodesHaveTwoRows) {
  scene::Scene scene = grid_scene(1, 3);
  scene.mesh.planar = true;
  const levels::BuiltMesh mesh(scene);
  using Phase = std::vector<std::uint32_t>;
  EXPECT_THAT(levels::order_for(mesh, spec::Schedule::sequential),
              ElementsAre(Phase{2}, Phase{3}, Phase{4}, Phase{5}));
}

} // namespace
} // namespace hopmesh::tests
