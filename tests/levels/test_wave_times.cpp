// Times in a wave: from the first edge of its window to the last, at whatever clock.
#include "tests/levels/wave_file.h"

#include <numeric>

namespace hopmesh::tests {
namespace {

constexpr std::uint64_t period = 10000; // picoseconds, at 100 MHz

std::uint64_t sum(const std::vector<std::uint64_t>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

/// Clocks run only while the array does: an edge a cycle, on one grid.
void expect_edges(const Vcd& vcd, std::uint64_t count, std::uint64_t clock) {
  const auto edges = vcd.at(".sequencer.clock").rises();
  EXPECT_EQ(edges.size(), count);
  for (std::uint64_t edge : edges) ASSERT_EQ(edge % clock, 0u) << edge;
}

class WaveTimes : public WaveFile {};

TEST_P(WaveTimes, HasAnEdgeForEveryCycleOfTheRun) {
  const Vcd vcd = wave(nine + " --steps 3");
  expect_edges(vcd, sum(cycles()), period);
  EXPECT_EQ(vcd.at(".device.irq").rises().size(), 3u);
  EXPECT_EQ(vcd.at(".sequencer.busy").last(), 0);
}

TEST_P(WaveTimes, HasThemAtAnyClock) {
  for (const auto& [mhz, clock] : std::vector<std::pair<std::string, std::uint64_t>>{
           {"1000", 1000}, {"333", 3003}, {"3", 333333}, {"0.001", 1000000000}}) {
    SCOPED_TRACE(mhz + " MHz");
    const Vcd vcd = wave(nine + " --steps 2 --set array.clock_mhz=" + mhz);
    expect_edges(vcd, sum(cycles()), clock);
  }
}

TEST_P(WaveTimes, WindowsOfStepsHoldTheirStepsOnly) {
  wave(nine + " --steps 4");
  const auto all = cycles();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [window, first, last] : std::vector<std::tuple<std::string, std::size_t, std::size_t>>{
           {"0:1", 0, 1}, {"1:3", 1, 3}, {"3:", 3, 4}, {":2", 0, 2}, {"2:99", 2, 4}}) {
    SCOPED_TRACE(window);
    const Vcd vcd = wave(nine + " --steps 4 --wave-window " + window);
    expect_edges(vcd, sum({all.begin() + first, all.begin() + last}), period);
  }
}

/// Wherever a window of cycles begins and ends: in a phase, at an end of one, at the ends of runs.
TEST_P(WaveTimes, WindowsOfCyclesHoldTheirCyclesOnly) {
  wave(nine + " --steps 3");
  const auto all = cycles();
  const std::uint64_t one = all[0], two = all[0] + all[1], total = sum(all);
  for (const auto& [first, last] : std::vector<std::pair<std::uint64_t, std::uint64_t>>{{0, 1},
                                                                                        {0, one},

                                                                                        {17, 40},

                                                                                        {one, one + 1},
                                                                                        {one - 1, one + 1},
                                                                                        {one, two},
                                                                                        {one + 7, two + 7},

                                                                                        {total - 1, total},
                                                                                        {1, total},
                                                                                        {30, total + 1000}}) {
    const std::string window = std::to_string(first) + ":" + std::to_string(last) + "c";
    SCOPED_TRACE(window);
    const Vcd vcd = wave(nine + " --steps 3 --wave-window " + window);
    expect_edges(vcd, std::min(last, total) - first, period);
    const auto edges = vcd.at(".sequencer.clock").rises();
    ASSERT_FALSE(edges.empty());
    EXPECT_GE(vcd.times.front() + period, edges.front()); // nothing from before the window
  }
}

TEST_P(WaveTimes, OutputsChangeOnEdgesOnly) {
  const Vcd vcd = wave(nine + " --steps 1");
  const auto edges = vcd.at(".sequencer.clock").rises();
  for (std::size_t k = 0; k < 24; ++k)
    for (const Vcd::Change& c : vcd.at(neuron(k / 3, k % 3) + ".output.V").changes)
      EXPECT_TRUE(c.picoseconds < edges.front() - period || // the host's start value
                  std::binary_search(edges.begin(), edges.end(), c.picoseconds))
          << c.picoseconds;
}

TEST_P(WaveTimes, RangesOfCellsAscendAndAreNoLongerThanMeshes) {
  for (const char* bad : {"3-1", "0-999999999"}) {
    refused(line(nine + " --steps 1 --out r --wave w.vcd --wave-cells " + bad));
  }
}

INSTANTIATE_TEST_SUITE_P(At, WaveTimes, testing::Values("systemc", "engine"),
                         [](const auto& level) { return level.param; });

} // namespace
} // namespace hopmesh::tests
