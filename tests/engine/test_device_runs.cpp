// Runs behind the engine's bus: the firmware's driver from doubles to doubles, a wait that is stopped and
// gone on with, and what a run takes over at START.
#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/presets.h"
#include "sim/engine/device.h"
#include "tests/engine/engine_bench.h"
#include "tests/support/driver_case.h"

#include <thread>

namespace hopmesh::tests {
namespace {

using engine::Device;
using spec::Window;

/// A device with a host's view of it.
struct Host {
  Host(const spec::ArraySpec& array, const spec::Topology& topology, const engine::Options& options = {})
      : map(spec::memory_map(array, topology)), device(array, topology, options, stop) {}
  std::uint32_t at(Window w) const { return static_cast<std::uint32_t>(map[w].offset); }
  std::uint32_t read(std::uint32_t address) {
    std::uint32_t word = 0;
    EXPECT_EQ(bus.read(bus.context, address, &word), HM_OK);
    return word;
  }
  Codes read(std::uint32_t address, std::size_t count) {
    Codes codes(count);
    EXPECT_EQ(bus.read_burst(bus.context, address, reinterpret_cast<std::uint32_t*>(codes.data()),
                             static_cast<std::uint32_t>(count)),
              HM_OK);
    return codes;
  }
  void write(std::uint32_t address, std::uint32_t word) {
    EXPECT_EQ(bus.write(bus.context, address, word), HM_OK);
  }
  void write(std::uint32_t address, const Codes& codes) {
    EXPECT_EQ(bus.write_burst(bus.context, address, reinterpret_cast<const std::uint32_t*>(codes.data()),
                              static_cast<std::uint32_t>(codes.size())),
              HM_OK);
  }
  int wait() { return bus.wait(bus.context); }

  void load_and_start(const ArrayJob& job) {
    write(at(Window::WEIGHT), job.weight);
    write(at(Window::BIAS), job.bias);
    write(at(Window::OUTPUT), job.start);
    if (!job.momentum.empty()) write(at(Window::MOMENTUM), job.momentum);
    write(HM_REG_STOP, spec::stop_word(job.rule));
    write(HM_REG_SUM_THRESHOLD_LO, static_cast<std::uint32_t>(job.rule.floor));
    write(HM_REG_SUM_THRESHOLD_HI, static_cast<std::uint32_t>(job.rule.floor >> 32));
    write(HM_REG_THRESHOLD, job.threshold);
    write(HM_REG_MAX_SWEEPS, job.max_sweeps);
    write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
    write(HM_REG_CONTROL, HM_CONTROL_START);
  }
  void expect(const ArrayResult& expected) {
    EXPECT_EQ(read(at(Window::OUTPUT), expected.output().size()), expected.output());
    EXPECT_EQ(read(HM_REG_SWEEPS), expected.sweeps);
    EXPECT_EQ(read(HM_REG_STATUS),
              static_cast<std::uint32_t>(HM_STATUS_DONE | (expected.converged ? HM_STATUS_CONVERGED : 0)));
    EXPECT_EQ(read(HM_REG_LARGEST_CHANGE), expected.largest_change);
    EXPECT_EQ(read(HM_REG_LARGEST_SUM_LO), static_cast<std::uint32_t>(expected.largest_sum));
    EXPECT_EQ(read(HM_REG_LARGEST_SUM_HI), static_cast<std::uint32_t>(expected.largest_sum >> 32));
    EXPECT_EQ(read(HM_REG_CYCLES_LO), static_cast<std::uint32_t>(expected.cycles));
    EXPECT_EQ(read(HM_REG_CYCLES_HI), static_cast<std::uint32_t>(expected.cycles >> 32));
  }

  const spec::MemoryMap map;
  std::atomic<bool> stop{false};
  Device device;
  const hm_bus& bus = device.bus();
};

/// Arrays of every output stage, with tables of m and rules to stop by.
TEST(EngineRuns, TakeTableAndRuleFromTheBus) {
  for (std::uint64_t seed = 610000; seed < 610200; ++seed) {
    Dice dice(seed);
    const spec::Topology topology = random_topology(dice, 30);
    spec::ArraySpec array = random_array(dice, topology.most_taps());
    array.packing = false;
    ArrayJob job = random_codes(dice, stepping_array(dice, array, topology.most_taps()), topology);
    give_rule(dice, job);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    Host host(job.array, job.topology);
    host.load_and_start(job);
    EXPECT_EQ(host.wait(), HM_OK);
    host.expect(run_slow_array(job));
    if (!job.momentum.empty()) {
      EXPECT_EQ(host.read(host.at(Window::MOMENTUM), job.momentum.size()), job.momentum);
    }
  }
}

class EngineDriverBatch : public testing::TestWithParam<int> {};

TEST_P(EngineDriverBatch, FromDoublesToDoubles) {
  for (int k = 0; k < 75; ++k) { // the cases of tests/cosim/test_driver.cpp
    DriverCase one(static_cast<std::uint64_t>(9000 + 75 * GetParam() + k));
    Host host(one.job.array, one.job.topology);
    one.relax_and_compare(host.bus);
  }
}

INSTANTIATE_TEST_SUITE_P(Batch, EngineDriverBatch, testing::Range(0, 4));

TEST(EngineDriver, ARunThatNobodyWaitedForDoesNotDisturbTheNext) {
  DriverCase one(9500);
  Host host(one.job.array, one.job.topology);
  std::uint32_t word;
  hm_driver driver;
  ASSERT_EQ(hm_driver_open(&driver, &host.bus, &one.mesh->mesh, &word, 1), HM_OK);
  host.write(HM_REG_CONTROL, HM_CONTROL_START);
  EXPECT_EQ(host.wait(), HM_OK);
  one.relax_and_compare(host.bus);
}

/// A run takes its cycles: whoever asks at once is told that the array is busy, and whoever asks often enough
/// sees it end without a wait.
TEST(EngineDriver, IsToldThatTheArrayIsBusyUntilTheRunIsOver) {
  DriverCase one(9501);
  Host host(one.job.array, one.job.topology);
  std::vector<std::uint32_t> buffer(64);
  hm_driver driver;
  hm_relaxation result;
  ASSERT_EQ(hm_driver_open(&driver, &host.bus, &one.mesh->mesh, buffer.data(), 64), HM_OK);
  host.write(HM_REG_CONTROL, HM_CONTROL_START);
  EXPECT_EQ(hm_driver_relax(&driver, &one.mesh->mesh, &one.mesh->network, 0.1, 3, &result), HM_ERROR_BUSY);
  const std::uint64_t run = slow_cycles(one.job, 1);
  std::uint64_t asked = 1; // by the driver, for STATUS, which is 2 cycles
  while (host.read(HM_REG_STATUS) & HM_STATUS_BUSY) asked += 1;
  EXPECT_EQ(asked, (run + 1) / 2);
  one.relax_and_compare(host.bus);
}

ArrayJob long_job() {
  Dice dice(1100000);
  ArrayJob job = random_codes(dice, spec::descent_array(), grid_topology(12, 12, true));
  job.threshold = 0;
  job.max_sweeps = 60;
  return job;
}

TEST(EngineWait, StoppedBySomeoneElseGoesOnWithTheNext) {
  const ArrayJob job = long_job();
  const ArrayResult expected = run_slow_array(job);
  Host host(job.array, job.topology);
  host.load_and_start(job);
  std::atomic<bool> over{false};
  std::thread nuisance([&] {
    while (!over) {
      host.stop = !host.stop;
      std::this_thread::yield();
    }
  });
  int answer;
  while ((answer = host.wait()) == HM_ERROR_STOPPED) {
  }
  over = true;
  nuisance.join();
  EXPECT_EQ(answer, HM_OK);
  host.expect(expected);
}

TEST(EngineWait, WithAStopThatStandsComesBackAtOnceAndDoesNothing) {
  const ArrayJob job = long_job();
  Host host(job.array, job.topology);
  host.load_and_start(job);
  host.stop = true;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(host.wait(), HM_ERROR_STOPPED);
  EXPECT_EQ(host.read(HM_REG_STATUS), static_cast<std::uint32_t>(HM_STATUS_BUSY));
  host.stop = false;
  EXPECT_EQ(host.wait(), HM_OK);
  host.expect(run_slow_array(job));
}

TEST(EngineWait, ForALineThatNothingWillRaiseComesBack) {
  Host host(spec::descent_array(), ring_topology(3));
  EXPECT_EQ(host.wait(), HM_ERROR_STOPPED); // no run
  host.write(HM_REG_CONTROL, HM_CONTROL_START);
  EXPECT_EQ(host.wait(), HM_ERROR_STOPPED); // a run, but nobody asked for its interrupt
  EXPECT_EQ(host.read(HM_REG_IRQ_STATUS), static_cast<std::uint32_t>(HM_IRQ_DONE));
  host.write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  EXPECT_EQ(host.wait(), HM_OK);
}

/// THRESHOLD and MAX_SWEEPS may be written while the array runs; they are for the next run.
TEST(EngineStart, TakesItsLimitsOver) {
  const ArrayJob job = long_job();
  Host host(job.array, job.topology);
  host.load_and_start(job);
  host.write(HM_REG_THRESHOLD, 1u << 20);
  host.write(HM_REG_MAX_SWEEPS, 1);
  EXPECT_EQ(host.wait(), HM_OK);
  host.expect(run_slow_array(job));
  EXPECT_EQ(host.read(HM_REG_MAX_SWEEPS), 1u);
}

} // namespace
} // namespace hopmesh::tests
