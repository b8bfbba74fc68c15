// The array that benchmarks compare with must do the same work: its outputs, sweeps and cycles against the
// production array's and the slow oracle's, on a tiny flag.
#include "rtl_model/spec/presets.h"
#include "tests/bench/sc_fixed_array.h"
#include "tests/support/dut.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::bench {
namespace {

using tests::ArrayJob;

ArrayJob tiny_job(std::uint64_t seed) {
  tests::Dice dice(seed);
  return tests::random_codes(dice, spec::default_array(), tests::grid_topology(3, 4, true));
}

std::vector<std::int32_t> within_one(const ArrayJob& job) {
  const auto one = static_cast<std::int32_t>(job.array.formats.state.one_raw());
  std::vector<std::int32_t> start = job.start;
  for (std::int32_t& v : start) v = std::min(std::max(v, -one), one);
  return start;
}

struct Pair {
  explicit Pair(std::uint64_t seed)
      : job(tiny_job(seed)), dut(("dut" + std::to_string(seed)).c_str(), job.array, job.topology),
        array(("fixed" + std::to_string(seed)).c_str(), job.array, job.topology) {}

  void run_and_compare() {
    dut.put_codes(tests::Window::WEIGHT, job.weight);
    dut.put_codes(tests::Window::BIAS, job.bias);
    dut.put_codes(tests::Window::OUTPUT, job.start);
    array.load(job.weight, job.bias, job.start);
    EXPECT_EQ(array.outputs_raw(), within_one(job));
    dut.start(job.threshold, job.max_sweeps);
    dut.run_until_done();
    array.run(job.threshold, job.max_sweeps);

    const auto slow = tests::run_slow_array(job);
    EXPECT_EQ(array.outputs_raw(), dut.codes(tests::Window::OUTPUT, job.topology.neurons()));
    EXPECT_EQ(array.outputs_raw(), slow.output());
    EXPECT_EQ(array.sweeps(), dut.read(HM_REG_SWEEPS));
    EXPECT_EQ(array.cycles(), dut.read(HM_REG_CYCLES_LO));
    EXPECT_EQ(array.cycles(), slow.cycles);
    EXPECT_EQ(array.largest_change_raw(), dut.read(HM_REG_LARGEST_CHANGE));
  }

  const ArrayJob job;
  tests::Dut dut;
  ScFixedArray array;
};

TEST(ScFixedArray, GivesTheProductionArraysCodesSweepsAndCycles) {
  std::vector<std::unique_ptr<Pair>> pairs;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) pairs.push_back(std::make_unique<Pair>(seed));
  for (auto& pair : pairs) {
    SCOPED_TRACE("seed of " + tests::describe(pair->job));
    pair->run_and_compare();
  }
}

TEST(ScFixedArray, RefusesAnArrayItIsNotWrittenFor) {
  const auto topology = tests::grid_topology(2, 2, true);
  EXPECT_THROW(ScFixedArray("descent", spec::descent_array(), topology), std::invalid_argument);
  spec::ArraySpec two_lanes = spec::default_array();
  two_lanes.lanes = 2;
  EXPECT_THROW(ScFixedArray("lanes", two_lanes, topology), std::invalid_argument);
}

} // namespace
} // namespace hopmesh::bench
