// The places that a layout gives to cells: each once, no link inside a group, sources as the links say, no
// link beyond the next chunk, and the order of firing that the schedule asks for.
#include "sim/engine/layout.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using engine::block_lanes;
using engine::Layout;
using engine::no_cell;
using spec::Schedule;

struct Case {
  explicit Case(std::uint64_t seed) : dice(seed) {
    topology = seed % 4 ? random_topology(dice, 120) : grid_topology(13, 11, seed % 8 == 0);
    schedule = dice.mode<Schedule>(spec::schedule_names);
    chunk_cells = dice.one_in(3) ? 0 : static_cast<std::size_t>(1 + dice.below(40));
    phases = spec::phases_of(topology, schedule);
  }
  Layout layout() const { return Layout(topology, phases, schedule, chunk_cells); }
  std::vector<std::uint32_t> groups() const { return engine::groups_of_cells(topology, phases, schedule); }

  Dice dice;
  spec::Topology topology;
  Schedule schedule;
  std::size_t chunk_cells;
  spec::Phases phases;
};

/// Calls check(case) for many meshes and chunks.
template <typename Check> void for_each_case(Check check) {
  for (std::uint64_t seed = 900000; seed < 900400 && !testing::Test::HasFailure(); ++seed) {
    const Case one(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::string(name_of(one.schedule)) + ", chunks of " +
                 std::to_string(one.chunk_cells));
    check(one);
  }
}

template <typename Visit> void for_each_link(const spec::Topology& t, Visit visit) {
  for (std::uint32_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
      visit(c, t.link_to[k], k - t.first_link[c]);
}

TEST(Layout, HasEachCellOnce) {
  for_each_case([](const Case& one) {
    const Layout l = one.layout();
    ASSERT_EQ(l.slot_of_cell.size(), one.topology.cells());
    ASSERT_EQ(l.cell_of_slot.size(), l.slots());
    std::size_t cells = 0;
    for (std::uint32_t cell : l.cell_of_slot) cells += cell != no_cell;
    EXPECT_EQ(cells, one.topology.cells());
    for (std::size_t c = 0; c < one.topology.cells(); ++c) ASSERT_EQ(l.cell_of_slot[l.slot_of_cell[c]], c);
  });
}

TEST(Layout, HasNoLinkInsideAGroup) {
  for_each_case([](const Case& one) {
    if (one.schedule == Schedule::synchronous) return;
    const auto group = one.groups();
    for_each_link(one.topology, [&](auto a, auto b, auto) { EXPECT_NE(group[a], group[b]); });
  });
}

/// Cell numbers in a block come from its own chunk and group.
TEST(Layout, KeepsChunksAndGroupsTogether) {
  for_each_case([](const Case& one) {
    const Layout l = one.layout();
    const auto group = one.groups();
    ASSERT_EQ(l.first_block.size(), l.chunks * l.groups + 1);
    EXPECT_EQ(l.first_block.back(), l.blocks());
    std::uint32_t chunk_begin = 0;
    for (std::size_t r = 0; r < l.chunks; ++r) {
      std::uint32_t chunk_end = chunk_begin;
      for (std::size_t g = 0; g < l.groups; ++g)
        for (std::size_t slot = l.first_block[r * l.groups + g] * block_lanes;
             slot < l.first_block[r * l.groups + g + 1] * block_lanes; ++slot) {
          const std::uint32_t cell = l.cell_of_slot[slot];
          if (cell == no_cell) continue;
          ASSERT_EQ(group[cell], g);
          ASSERT_GE(cell, chunk_begin);
          chunk_end = std::max(chunk_end, cell + 1);
        }
      chunk_begin = chunk_end;
    }
    EXPECT_EQ(chunk_begin, one.topology.cells());
  });
}

TEST(Layout, LetsNoLinkReachBeyondTheNextChunk) {
  std::size_t several = 0;
  for_each_case([&](const Case& one) {
    const Layout l = one.layout();
    several += l.chunks > 2;
    std::vector<std::ptrdiff_t> chunk(one.topology.cells());
    for (std::size_t c = 0; c < chunk.size(); ++c) {
      const std::size_t block = l.slot_of_cell[c] / block_lanes;
      while (l.first_block[static_cast<std::size_t>(chunk[c] + 1) * l.groups] <= block) ++chunk[c];
    }
    for_each_link(one.topology, [&](auto a, auto b, auto) { EXPECT_LE(std::abs(chunk[a] - chunk[b]), 1); });
    if (one.chunk_cells == 0) {
      EXPECT_EQ(l.chunks, 1u);
    }
  });
  EXPECT_GT(several, 30u);
}

TEST(Layout, KnowsWhichGroupsMeetAcrossChunks) {
  for_each_case([&](const Case& one) {
    const Layout l = one.layout();
    const auto group = engine::groups_of_cells(one.topology, one.phases, one.schedule);
    std::vector<bool> meet(l.groups * l.groups, false);
    std::vector<std::size_t> chunk(one.topology.cells(), 0);
    for (std::size_t c = 0; c < chunk.size(); ++c)
      while (l.first_block[(chunk[c] + 1) * l.groups] <= l.slot_of_cell[c] / block_lanes) ++chunk[c];
    for_each_link(one.topology, [&](auto a, auto b, auto) {
      if (chunk[a] != chunk[b]) meet[group[a] * l.groups + group[b]] = true;
    });
    for (std::size_t k = 0; k < meet.size() && l.chunks > 1; ++k)
      EXPECT_EQ(l.groups_meet_across_chunks(k / l.groups, k % l.groups), meet[k]) << k;
  });
}

/// Whole rows: of 11 cells with diagonals, of 12 without.
TEST(Layout, CutsGridsBetweenRows) {
  for (const bool diagonals : {false, true}) {
    const spec::Topology t = grid_topology(9, diagonals ? 11 : 12, diagonals);
    const auto phases = phases_of(t, spec::Schedule::coloured);
    EXPECT_EQ(Layout(t, phases, spec::Schedule::coloured, 5).chunks, 9u);
    EXPECT_EQ(Layout(t, phases, spec::Schedule::coloured, 13).chunks, 5u);
    EXPECT_EQ(Layout(t, phases, spec::Schedule::coloured, 0).chunks, 1u);
  }
}

TEST(Layout, FindsEverySource) {
  for_each_case([](const Case& one) {
    const Layout l = one.layout();
    const spec::Topology& t = one.topology;
    for_each_link(t, [&](auto a, auto b, auto k) {
      const std::size_t slot = l.slot_of_cell[a], block = slot / block_lanes;
      ASSERT_LT(k, l.neighbours[block]);
      EXPECT_EQ(l.source[l.first_source[block] + k * block_lanes + slot % block_lanes], l.slot_of_cell[b]);
    });
    for (std::size_t slot = 0; slot < l.slots(); ++slot) {
      const std::size_t block = slot / block_lanes;
      const std::uint32_t cell = l.cell_of_slot[slot];
      ASSERT_EQ(l.degree[slot], cell == no_cell ? 0 : t.degree(cell));
      for (std::size_t k = l.degree[slot]; k < l.neighbours[block]; ++k)
        EXPECT_EQ(l.source[l.first_source[block] + k * block_lanes + slot % block_lanes], slot);
    }
  });
}

TEST(Layout, KnowsHowFarLinksReach) {
  EXPECT_EQ(engine::link_reach(topology_of(5, 3, {})), 0u);
  EXPECT_EQ(engine::link_reach(grid_topology(4, 7, false)), 7u);
  EXPECT_EQ(engine::link_reach(grid_topology(4, 7, true)), 8u);
  EXPECT_EQ(engine::link_reach(ring_topology(9)), 8u);
}

/// What each cell's neighbours have become when it reads them, with cells taken in the order of the schedule:
/// 1 for a neighbour that fired before it in the same sweep.
TEST(Layout, SequentialGroupsReadWhatNeuronByNeuronReads) {
  for_each_case([](const Case& one) {
    const auto level = engine::groups_of_cells(one.topology, one.phases, Schedule::sequential);
    for_each_link(one.topology, [&](auto a, auto b, auto) { EXPECT_EQ(level[b] < level[a], b < a); });
    std::uint32_t last = 0;
    for (std::uint32_t k : level) last = std::max(last, k);
    std::vector<bool> used(last + 1, false);
    for (std::uint32_t k : level) used[k] = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0); // no sweep has an empty group
  });
}

/// The colours in their order, so that phase by phase and group by group is the same.
TEST(Layout, ColouredGroupsFireInTheOrderOfThePhases) {
  for_each_case([](const Case& one) {
    const spec::Phases phases = spec::phases_of(one.topology, Schedule::coloured);
    const auto colour = engine::groups_of_cells(one.topology, phases, Schedule::coloured);
    const auto phase = spec::phase_of_neurons(one.topology, phases);
    const auto per_cell = static_cast<std::size_t>(one.topology.neurons_per_cell);
    for_each_link(one.topology, [&](auto a, auto b, auto) {
      EXPECT_EQ(colour[b] < colour[a], phase[b * per_cell + per_cell - 1] < phase[a * per_cell]);
    });
  });
}

} // namespace
} // namespace hopmesh::tests
