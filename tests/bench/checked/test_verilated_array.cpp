// The Verilog models against the slow array: raw codes, sweeps, convergence, largest change and cycles of
// random networks, and every V at every cycle: absent at n - 1, present at n (docs/hardware/cycles.md).
#include "rtl_model/spec/presets.h"
#include "tests/bench/array_package.h"
#include "tests/support/random_network.h"

#include <neuron_modules_narrow.h>
#include <neuron_modules_narrow___024root.h>
#include <neuron_modules_narrow_shared_wires.h>
#include <neuron_modules_planar.h>
#include <neuron_modules_planar___024root.h>
#include <neuron_modules_planar_shared_wires.h>
#include <neuron_modules_small.h>
#include <neuron_modules_small___024root.h>
#include <neuron_modules_small_shared_wires.h>
#include <time_multiplexed_byte.h>
#include <time_multiplexed_byte___024root.h>
#include <time_multiplexed_narrow.h>
#include <time_multiplexed_narrow___024root.h>
#include <time_multiplexed_small.h>
#include <time_multiplexed_small___024root.h>

#include "tests/bench/verilated_model.h"

#include <gtest/gtest.h>

namespace hopmesh::bench {
namespace {

using tests::ArrayJob;

constexpr int seeds = 60;

ArrayJob random_codes(std::uint64_t seed, const BenchNetwork& network) {
  tests::Dice dice(seed);
  return tests::random_codes(dice, network.array, network.topology);
}

/// A job that moves in every sweep, for looking at each cycle.
ArrayJob lively_job(std::uint64_t seed, const BenchNetwork& network) {
  ArrayJob job;
  do {
    job = random_codes(seed, network);
    job.threshold = 0;
    job.max_sweeps = 3;
    seed += 1000;
  } while (tests::run_slow_array(job).sweeps != 3);
  return job;
}

void load(VerilatedArray& array, const ArrayJob& job) {
  array.load(job.weight, job.bias);
  array.load_start(job.start);
}

void expect_result(const VerilatedArray& array, const tests::ArrayResult& slow) {
  EXPECT_EQ(array.outputs_raw(), slow.output());
  EXPECT_EQ(array.sweeps(), slow.sweeps);
  EXPECT_EQ(array.converged(), slow.converged);
  EXPECT_EQ(array.largest_change_raw(), slow.largest_change);
  EXPECT_EQ(array.cycles(), slow.cycles);
}

void run_and_compare(VerilatedArray& array, const ArrayJob& job) {
  load(array, job);
  array.run(job.threshold, job.max_sweeps);
  expect_result(array, tests::run_slow_array(job));
}

/// Cycles after which each neuron publishes in the first sweep, counted by hand: take START, prepare, then
/// T + 2 + 2 a phase. The last entry is the sweep's length.
std::vector<std::uint64_t> publications(const ArrayJob& job, std::uint64_t& sweep) {
  const std::size_t per_cell = job.topology.neurons_per_cell;
  std::vector<std::uint64_t> at(job.topology.neurons());
  std::uint64_t longest = job.topology.most_taps();
  const std::uint64_t first = 1 + longest + job.array.reciprocal_bits + 1;
  std::uint64_t now = first;
  for (const auto& phase : spec::phases_of(job.topology, job.array.schedule)) {
    std::uint64_t row = 0;
    for (std::uint32_t i : phase) row = std::max<std::uint64_t>(row, job.topology.taps(i / per_cell));
    now += row + 2 + 2;
    for (std::uint32_t i : phase) at[i] = now;
  }
  sweep = now + 1 - first;
  return at;
}

std::vector<std::int32_t> within_one(const ArrayJob& job) {
  const int unused = 32 - job.array.formats.state.width;
  const auto one = static_cast<std::int32_t>(job.array.formats.state.one_raw());
  std::vector<std::int32_t> start;
  for (std::int32_t v : job.start) {
    const std::int32_t cut = static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << unused) >> unused;
    start.push_back(std::min(std::max(cut, -one), one));
  }
  return start;
}

void expect_every_cycle(VerilatedArray& array, const ArrayJob& job) {
  load(array, job);
  const auto slow = tests::run_slow_array(job, tests::Keep::every_sweep);
  std::uint64_t sweep = 0;
  const auto published = publications(job, sweep);
  std::vector<std::int32_t> expected = within_one(job);
  ASSERT_EQ(array.outputs_raw(), expected);
  array.begin_run(job.threshold, job.max_sweeps);
  for (std::uint64_t n = 1; n <= slow.cycles + 2; ++n) {
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (n >= published[i] && (n - published[i]) % sweep == 0 && (n - published[i]) / sweep < slow.sweeps)
        expected[i] = slow.history[(n - published[i]) / sweep][i];
    ASSERT_EQ(array.outputs_raw(), expected) << "cycle " << n;
    ASSERT_EQ(array.busy(), n < slow.cycles) << "cycle " << n;
    array.step_clock();
  }
  expect_result(array, slow);
}

/// A single model, many networks, each loaded over the one before.
template <class Array> void compare_many(const char* name) {
  const BenchNetwork network = bench_network(name);
  Array array(network);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const ArrayJob job = random_codes(seed, network);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + tests::describe(job));
    run_and_compare(array, job);
  }
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ArrayJob job = lively_job(seed, network);
    SCOPED_TRACE("lively seed " + std::to_string(seed) + ": " + tests::describe(job));
    expect_every_cycle(array, job);
  }
}

TEST(NeuronModules, DefaultArray) {
  compare_many<NeuronModules<neuron_modules_small>>("small");
}

TEST(NeuronModules, TwoNeuronsACell) {
  compare_many<NeuronModules<neuron_modules_planar>>("planar");
}

TEST(NeuronModules, SixteenBitsTowardZero) {
  compare_many<NeuronModules<neuron_modules_narrow>>("narrow");
}

TEST(TimeMultiplexed, DefaultArray) {
  compare_many<TimeMultiplexed<time_multiplexed_small>>("small");
}

TEST(TimeMultiplexed, SixteenBitsTowardZero) {
  compare_many<TimeMultiplexed<time_multiplexed_narrow>>("narrow");
}

TEST(TimeMultiplexed, EightBits) {
  compare_many<TimeMultiplexed<time_multiplexed_byte>>("byte");
}

TEST(TimeMultiplexed, RunsGoOnFromWhereTheLastOneStopped) {
  const BenchNetwork network = bench_network("small");
  TimeMultiplexed<time_multiplexed_small> shared(network);
  NeuronModules<neuron_modules_small> modules(network);
  const ArrayJob job = lively_job(9, network);
  const auto slow = tests::run_slow_array(job, tests::Keep::every_sweep);
  for (VerilatedArray* array :
       {static_cast<VerilatedArray*>(&shared), static_cast<VerilatedArray*>(&modules)}) {
    load(*array, job);
    for (const auto& outputs : slow.history) {
      array->run(0, 1);
      EXPECT_EQ(array->outputs_raw(), outputs);
    }
  }
}

/// Any mesh that fits, in any schedule: the model loads them.
TEST(TimeMultiplexed, RandomMeshesAndSchedules) {
  int ran = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    tests::Dice dice(seed);
    BenchNetwork network = bench_network("small");
    network.topology = tests::random_topology(dice, 40);
    network.array.schedule = dice.mode<spec::Schedule>(spec::schedule_names);
    try {
      TimeMultiplexed<time_multiplexed_small> array(network);
      const ArrayJob job = random_codes(seed, network);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + tests::describe(job));
      run_and_compare(array, job);
      ++ran;
    } catch (const std::invalid_argument&) { // no room
    }
  }
  EXPECT_GT(ran, 150);
}

TEST(TimeMultiplexed, RefusesWhatItHasNoRoomFor) {
  EXPECT_THROW(TimeMultiplexed<time_multiplexed_small>(bench_network("flag")), std::invalid_argument);
}

TEST(ArrayPackage, RefusesArraysThatTheModelsDoNotKnow) {
  BenchNetwork network = bench_network("small");
  const auto package = [&network] { return array_package(network.array, network.topology, {}); };
  EXPECT_NO_THROW(package());
  network.array.lanes = 2;
  EXPECT_THROW(package(), std::invalid_argument);
  network.array = spec::default_array();
  network.array.normaliser = spec::Normaliser::divider;
  EXPECT_THROW(package(), std::invalid_argument);
  network.array = spec::default_array();
  network.array.exact_accumulator = false;
  EXPECT_THROW(package(), std::invalid_argument);
  network.array = spec::default_array();
  network.array.reciprocal_bits = 32;
  EXPECT_THROW(package(), std::invalid_argument);
  EXPECT_THROW(bench_network("large"), std::invalid_argument);
}

} // namespace
} // namespace hopmesh::bench
