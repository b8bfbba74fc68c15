// Colours, phases and cycles: proper on any graph, and the numbers by hand on small ones.
#include "rtl_model/spec/cycles.h"
#include "tests/support/random_network.h"
#include "tests/support/slow_colouring.h"

#include <gtest/gtest.h>

#include <set>

namespace hopmesh::tests {
namespace {

using spec::ArraySpec;
using spec::Schedule;
using spec::Topology;

std::size_t colours_of(const Topology& t) {
  const auto colour = spec::colour_cells(t);
  return std::set<std::uint32_t>(colour.begin(), colour.end()).size();
}

bool linked(const Topology& t, std::size_t a, std::size_t b) {
  return std::count(t.link_to.begin() + t.first_link[a], t.link_to.begin() + t.first_link[a + 1], b) != 0;
}

TEST(Schedule, NoTwoLinkedCellsShareAColour) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Dice dice(seed);
    const Topology t = random_topology(dice, 60);
    const auto colour = spec::colour_cells(t);
    for (std::size_t c = 0; c < t.cells(); ++c)
      for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
        ASSERT_NE(colour[c], colour[t.link_to[k]]) << "seed " << seed << ", cell " << c;
  }
}

/// Any edge is there with the probability given.
Topology random_graph(Dice& dice, std::size_t cells, double probability) {
  Edges edges;
  for (std::uint32_t a = 0; a < cells; ++a)
    for (std::uint32_t b = a + 1; b < cells; ++b)
      if (dice.unit() < probability) edges.push_back({a, b});
  return topology_of(cells, 3, edges);
}

TEST(Schedule, ColoursAreThoseOfTheRuleCellByCell) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Dice dice(seed);
    const Topology t = random_topology(dice, 300);
    ASSERT_EQ(spec::colour_cells(t), slow_colours(t)) << "seed " << seed;
  }
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Dice dice(seed);
    const Topology t = random_graph(dice, 1 + dice.below(200), dice.unit());
    ASSERT_EQ(spec::colour_cells(t), slow_colours(t)) << "seed " << seed;
  }
}

TEST(Schedule, ColoursOfLargeMeshesAreThoseOfTheRule) {
  for (bool diagonals : {false, true}) // 4,900 cells: three layers of the set of numbers
    EXPECT_EQ(spec::colour_cells(grid_topology(70, 70, diagonals)),
              slow_colours(grid_topology(70, 70, diagonals)));
}

TEST(Schedule, MoreColoursThanAWordHasBits) {
  Dice dice(1);
  for (std::size_t cells : {64, 65, 66, 130}) {
    const Topology all = random_graph(dice, cells, 1.0); // each knows all others: as many colours as cells
    EXPECT_EQ(colours_of(all), cells);
    EXPECT_EQ(spec::colour_cells(all), slow_colours(all)) << cells;
  }
  const Topology dense = random_graph(dice, 400, 0.9);
  EXPECT_GT(colours_of(dense), 64u);
  EXPECT_EQ(spec::colour_cells(dense), slow_colours(dense));
}

TEST(Schedule, BipartiteMeshesNeedTwoColours) {
  EXPECT_EQ(colours_of(grid_topology(20, 19, false)), 2u);
  EXPECT_EQ(colours_of(ring_topology(10)), 2u);
  EXPECT_EQ(colours_of(ring_topology(11)), 3u);
  EXPECT_EQ(colours_of(topology_of(7, 3, {})), 1u);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Dice dice(seed);
    const std::size_t left = 1 + dice.below(20), right = 1 + dice.below(20);
    Edges edges{{0, static_cast<std::uint32_t>(left)}};
    for (int k = 0; k < 60; ++k)
      edges.push_back({static_cast<std::uint32_t>(dice.below(left)),
                       static_cast<std::uint32_t>(left + dice.below(right))});
    EXPECT_EQ(colours_of(topology_of(left + right, 3, edges)), 2u) << "seed " << seed;
  }
}

TEST(Schedule, ShearedGridsNeedFourColours) {
  // A square with both diagonals is four cells that all know each other: fewer is impossible.
  for (std::size_t rows = 2; rows <= 24; ++rows)
    for (std::size_t columns = 2; columns <= 24; ++columns)
      ASSERT_EQ(colours_of(grid_topology(rows, columns, true)), 4u) << rows << " x " << columns;
}

TEST(Schedule, TheFlagOf400NodesFiresInTwelvePhases) {
  const Topology t = grid_topology(20, 19, true); // 20 x 20 with the left column pinned
  EXPECT_EQ(t.cells(), 380u);
  EXPECT_EQ(spec::phases_of(t, Schedule::coloured).size(), 4u * 3u);
  EXPECT_EQ(spec::phases_of(t, Schedule::sequential).size(), 380u * 3u);
  EXPECT_EQ(spec::phases_of(t, Schedule::synchronous).size(), 1u);
}

TEST(Schedule, EverySweepFiresEveryNeuronOnce) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (Schedule schedule : {Schedule::coloured, Schedule::sequential, Schedule::synchronous}) {
      Dice dice(seed);
      const Topology t = random_topology(dice, 60);
      std::vector<int> fired(t.neurons(), 0);
      for (const auto& phase : spec::phases_of(t, schedule)) {
        EXPECT_FALSE(phase.empty()) << "seed " << seed;
        EXPECT_TRUE(std::is_sorted(phase.begin(), phase.end())) << "seed " << seed;
        for (std::uint32_t i : phase) fired[i] += 1;
      }
      EXPECT_EQ(std::count(fired.begin(), fired.end(), 1), std::ptrdiff_t(t.neurons())) << "seed " << seed;
    }
}

TEST(Schedule, NeuronsOfAColouredPhaseShareNoWeight) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Dice dice(seed);
    const Topology t = random_topology(dice, 40);
    for (const auto& phase : spec::phases_of(t, Schedule::coloured))
      for (std::uint32_t a : phase)
        for (std::uint32_t b : phase) {
          const std::size_t cell = a / t.neurons_per_cell, other = b / t.neurons_per_cell;
          ASSERT_TRUE(a == b || (cell != other && !linked(t, cell, other)))
              << "seed " << seed << ": " << a << ", " << b;
        }
  }
}

TEST(Schedule, AnEmptyMeshHasNoPhases) {
  EXPECT_TRUE(spec::phases_of(Topology{}, Schedule::coloured).empty());
}

TEST(Topology, RowsFollowEachOtherWithoutGaps) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Dice dice(seed);
    const Topology t = random_topology(dice, 60);
    std::size_t next = 0;
    for (std::size_t c = 0; c < t.cells(); ++c)
      for (int p = 0; p < t.neurons_per_cell; ++p) {
        ASSERT_EQ(t.row_offset(c, p), next) << "seed " << seed;
        next += t.taps(c);
      }
    EXPECT_EQ(next, t.weight_words());
  }
}

TEST(Cycles, OneCellByHand) {
  // An isolated cell: 3 taps. Divider at 14 fraction bits: 16; output 2. With 3 lanes a phase is 1 + 16 + 2.
  const Topology t = topology_of(1, 3, {});
  ArraySpec a;
  a.schedule = Schedule::coloured;
  a.normaliser = spec::Normaliser::divider;
  a.formats.drive = {16, 2, spec::Rounding::trn_zero, spec::Overflow::sat};
  a.lanes = 3;
  auto m = spec::cycle_model(a, t, spec::phases_of(t, a.schedule));
  EXPECT_EQ(m.phase, (std::vector<std::uint64_t>{19, 19, 19}));
  EXPECT_EQ(m.sweep, 58u);
  EXPECT_EQ(m.prepare, 1u);
  EXPECT_EQ(m.run(1), 60u);
  EXPECT_EQ(m.run(10), 582u);
  a.lanes = 2; // 3 taps in 2 cycles
  m = spec::cycle_model(a, t, spec::phases_of(t, a.schedule));
  EXPECT_EQ(m.sweep, 3u * 20u + 1u);
  EXPECT_EQ(m.prepare, 2u);
}

TEST(Cycles, NormalisersByHand) {
  // Two linked planar cells: 4 taps, 1 lane: 4 cycles a row; two colours of two phases.
  const Topology t = topology_of(2, 2, {{0, 1}});
  ArraySpec a;
  a.lanes = 1;
  a.normaliser = spec::Normaliser::prescaled;
  auto m = spec::cycle_model(a, t, spec::phases_of(t, Schedule::coloured));
  EXPECT_EQ(m.sweep, 4u * (4 + 1 + 2) + 1);
  EXPECT_EQ(m.prepare, 0u);
  EXPECT_EQ(m.run(3), 1u + 3 * 29);
  a.normaliser = spec::Normaliser::reciprocal;
  a.reciprocal_bits = 18;
  m = spec::cycle_model(a, t, spec::phases_of(t, Schedule::coloured));
  EXPECT_EQ(m.sweep, 4u * (4 + 2 + 2) + 1);
  EXPECT_EQ(m.prepare, 4u + 18 + 1);
  m = spec::cycle_model(a, t, spec::phases_of(t, Schedule::synchronous));
  EXPECT_EQ(m.sweep, 1u * (4 + 2 + 2) + 1);
}

TEST(Cycles, BinaryOutputsByHand) {
  // A path 0 - 1 - 2 of cells of one neuron: rows of 2, 3 and 2 taps. The sign takes one cycle, V another,
  // and nothing is prepared, whatever normaliser a modified output would have.
  const Topology t = topology_of(3, 1, {{0, 1}, {1, 2}});
  for (int normaliser = 0; normaliser < 3; ++normaliser) {
    ArraySpec a;
    a.output = spec::Output::binary;
    a.normaliser = static_cast<spec::Normaliser>(normaliser);
    const auto m = spec::cycle_model(a, t, spec::phases_of(t, Schedule::sequential));
    EXPECT_EQ(m.phase, (std::vector<std::uint64_t>{4, 5, 4}));
    EXPECT_EQ(m.sweep, 14u);
    EXPECT_EQ(m.prepare, 0u);
    EXPECT_EQ(m.run(10), 141u);
    EXPECT_EQ(spec::cycle_model(a, t, spec::phases_of(t, Schedule::coloured)).sweep, 5u + 4u + 1u);
  }
}

TEST(Cycles, APhaseWaitsForItsLongestRow) {
  // A path 0 - 1 - 2 and an isolated cell 3: rows of 6, 9, 6 and 3 taps; sequential, one lane, prescaled.
  const Topology t = topology_of(4, 3, {{0, 1}, {1, 2}});
  ArraySpec a;
  a.schedule = Schedule::sequential;
  a.normaliser = spec::Normaliser::prescaled;
  a.lanes = 1;
  const auto m = spec::cycle_model(a, t, spec::phases_of(t, a.schedule));
  EXPECT_EQ(m.phase, (std::vector<std::uint64_t>{9, 9, 9, 12, 12, 12, 9, 9, 9, 6, 6, 6}));
  EXPECT_EQ(m.sweep, 109u);
}

TEST(Segments, FollowEachOtherAsThePageSays) {
  const spec::CycleModel m{2, {4, 3}, 8};
  std::vector<int> walked{spec::Segment::idle};
  for (int sweeps = 0; walked.size() < 2 || walked.back() != spec::Segment::idle;) {
    sweeps += walked.back() == spec::Segment::check;
    walked.push_back(spec::next_segment(m, walked.back(), sweeps == 2));
  }
  using S = spec::Segment;
  const int one = S::first_phase, two = S::first_phase + 1;
  EXPECT_EQ(walked, (std::vector<int>{S::idle, S::start, S::prepare, one, two, S::check, one, two, S::check,
                                      S::idle}));
  EXPECT_EQ(spec::next_segment({0, {4}, 5}, S::start, false), one); // nothing to prepare
}

TEST(Segments, LastAsLongAsTheRunTheyMakeUp) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const ArrayJob job = random_job(seed);
    const auto m =
        spec::cycle_model(job.array, job.topology, spec::phases_of(job.topology, job.array.schedule));
    std::uint64_t cycles = 0, sweeps = 0;
    int at = spec::Segment::idle;
    do {
      at = spec::next_segment(m, at, sweeps == 3);
      sweeps += at == spec::Segment::check;
      cycles += spec::segment_cycles(m, at);
    } while (at != spec::Segment::idle);
    EXPECT_EQ(cycles, slow_cycles(job, 3)) << "seed " << seed;
  }
}

TEST(Cycles, TheOraclesTableAndTheModelsFormulaAgree) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const ArrayJob job = random_job(seed);
    const auto m =
        spec::cycle_model(job.array, job.topology, spec::phases_of(job.topology, job.array.schedule));
    for (std::uint32_t sweeps : {1, 2, 300})
      EXPECT_EQ(m.run(sweeps), slow_cycles(job, sweeps)) << "seed " << seed;
  }
}

TEST(Cycles, TheBusTakesOneForTheAddressAndThenBeats) {
  ArraySpec a;
  const std::vector<std::pair<int, std::uint64_t>> expected{{32, 8}, {64, 5}, {128, 3}}; // 7 words
  for (const auto& [bits, cycles] : expected) {
    a.bus_bits = bits;
    EXPECT_EQ(spec::bus_cycles(a, 7), cycles) << bits;
    EXPECT_EQ(spec::bus_cycles(a, 1), 2u) << bits;
  }
}

} // namespace
} // namespace hopmesh::tests
