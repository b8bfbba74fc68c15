// The SystemC array against the slow one: 10,000 random networks on as many random arrays, raw code by raw
// code, with sweeps, the convergence bit, the largest change and the cycles. Forty batches, one elaboration
// each.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "tests/support/dut_job.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

#include <memory>

namespace hopmesh::tests {
namespace {

constexpr int batches = 40, batch_size = 250, slower_batch_size = 50;

/// A device beside the job it is to do and what the slow array makes of it.
struct NetworkBench {
  NetworkBench(std::uint64_t seed_of_job, const ArrayJob& a_job)
      : seed(seed_of_job), job(a_job), expected(run_slow_array(job, Keep::every_sweep)),
        dut(("dut" + std::to_string(seed)).c_str(), job.array, job.topology) {}

  void expect_run() {
    EXPECT_EQ(dut.codes(Window::OUTPUT, job.topology.neurons()), expected.output());
    EXPECT_EQ(dut.read(HM_REG_SWEEPS), expected.sweeps);
    EXPECT_EQ(dut.read(HM_REG_STATUS),
              static_cast<std::uint32_t>(HM_STATUS_DONE | (expected.converged ? HM_STATUS_CONVERGED : 0)));
    EXPECT_EQ(dut.read(HM_REG_LARGEST_CHANGE), expected.largest_change);
    EXPECT_EQ(wide(HM_REG_CYCLES_LO), expected.cycles);
    EXPECT_EQ(wide(HM_REG_LARGEST_SUM_LO), expected.largest_sum);
  }

  /// A register of two words: the lower one is read first.
  std::uint64_t wide(std::uint32_t low) {
    const std::uint64_t word = dut.read(low);
    return word | std::uint64_t{dut.read(low + 4)} << 32;
  }

  std::string text() const { return "seed " + std::to_string(seed) + ": " + describe(job); }

  const std::uint64_t seed;
  const ArrayJob job;
  const ArrayResult expected;
  Dut dut;
};

using Benches = std::vector<std::unique_ptr<NetworkBench>>;

Benches make_benches(int batch, int size = batch_size) {
  Benches benches;
  for (int k = 0; k < size; ++k) {
    const std::uint64_t seed = 1 + static_cast<std::uint64_t>(batch) * batch_size + k;
    benches.push_back(std::make_unique<NetworkBench>(seed, random_job(seed)));
  }
  return benches;
}

/// All devices at once, in one simulated time.
void run_all(const Benches& benches, systemc::Waking waking) {
  for (const auto& bench : benches) {
    SCOPED_TRACE(bench->text());
    load(bench->dut, bench->job);
    bench->dut.device.wake(waking);
    bench->dut.start(bench->job.threshold, bench->job.max_sweeps);
  }
  for (const auto& bench : benches) bench->dut.run_until_done();
  for (const auto& bench : benches) {
    SCOPED_TRACE(bench->text());
    bench->expect_run();
  }
}

class CosimNetworks : public testing::TestWithParam<int> {};

TEST_P(CosimNetworks, WokenByPhase) {
  run_all(make_benches(GetParam()), systemc::Waking::by_phase);
}

TEST_P(CosimNetworks, WokenByClock) {
  run_all(make_benches(GetParam(), slower_batch_size), systemc::Waking::by_clock);
}

TEST_P(CosimNetworks, AfterEverySweep) {
  const Benches benches = make_benches(GetParam(), slower_batch_size);
  for (const auto& bench : benches) {
    SCOPED_TRACE(bench->text());
    const bool momentum = bench->job.array.output == spec::Output::momentum;
    load(bench->dut, bench->job);
    for (std::size_t sweep = 0; sweep < bench->expected.history.size(); ++sweep) {
      // What momentum does in a sweep depends on those before it, so there the run is made longer.
      if (momentum) bench->dut.put_codes(Window::OUTPUT, bench->job.start);
      bench->dut.start(momentum ? bench->job.threshold : 0,
                       momentum ? static_cast<std::uint32_t>(sweep) + 1 : 1);
      bench->dut.run_until_done();
      ASSERT_EQ(bench->dut.codes(Window::OUTPUT, bench->job.topology.neurons()),
                bench->expected.history[sweep])
          << "sweep " << sweep + 1;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Batch, CosimNetworks, testing::Range(0, batches));

/// Named arrays on the mesh of a small flag, long enough to converge.
TEST(CosimPresets, EveryPresetOnASmallFlag) {
  Benches benches;
  std::uint64_t seed = 5000;
  for (spec::ArraySpec array : spec::presets())
    for (spec::Schedule schedule :
         {spec::Schedule::coloured, spec::Schedule::sequential, spec::Schedule::synchronous}) {
      array.schedule = schedule;
      if (spec::validate(array)) continue;
      Dice dice(++seed);
      ArrayJob job = random_codes(dice, array, grid_topology(5, 4, true));
      job.momentum.assign(table_entries(array), 20'000);
      job.threshold = 1;
      job.max_sweeps = 40;
      benches.push_back(std::make_unique<NetworkBench>(seed, job));
    }
  run_all(benches, systemc::Waking::by_phase);
}

} // namespace
} // namespace hopmesh::tests
