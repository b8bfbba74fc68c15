// What can be seen of an array after each cycle, as docs/hardware/cycles.md promises it; several arrays
// beside each other.
#pragma once

#include "tests/support/slow_fold.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

/// The page's table once more, by counting.
struct Promise {
  Promise(const ArrayJob& j, systemc::Waking waking)
      : job(j), phases(spec::phases_of(j.topology, j.array.schedule)), written(j.topology.neurons()) {
    if (job.array.elements > 0)
      promise_fold(waking);
    else
      promise_cells();
  }
  /// All neurons of a phase publish at its end.
  void promise_cells() {
    const bool binary = job.array.output == spec::Output::binary;
    std::uint64_t at = 0, longest = 0;
    for (const auto& phase : phases) {
      const std::uint64_t row = longest_row(phase);
      longest = std::max(longest, row);
      at += row + slow_stage(job.array);
      for (std::uint32_t i : phase) written[i] = at;
    }
    sweep = at + 1;
    first = 1;
    if (binary) return;
    if (job.array.normaliser != spec::Normaliser::prescaled) first += longest;
    if (job.array.normaliser == spec::Normaliser::reciprocal) first += job.array.reciprocal_bits + 1;
  }
  /// Each publishes for itself; woken by phase, they show it together.
  void promise_fold(systemc::Waking waking) {
    const SlowSweep slow = slow_folded_sweep(job);
    written = slow.written;
    std::uint64_t at = 0;
    for (std::size_t k = 0; k < phases.size(); ++k) {
      at += slow.phases[k];
      for (std::uint32_t i : phases[k])
        if (waking == systemc::Waking::by_phase) written[i] = at;
    }
    sweep = at + 1;
    first = 1 + slow_folded_prepare(job);
  }
  std::uint64_t longest_row(const std::vector<std::uint32_t>& neurons) const {
    std::uint64_t beats = 0;
    for (std::uint32_t i : neurons) {
      std::uint64_t b = 0;
      for (std::size_t done = 0; done < job.topology.taps(i / job.topology.neurons_per_cell); ++b)
        done += job.array.lanes;
      beats = std::max(beats, b);
    }
    return beats;
  }
  /// How often neuron i has published when n cycles have passed.
  std::size_t publications(std::uint32_t i, std::uint64_t n) const {
    const std::uint64_t once = first + written[i];
    return n < once ? 0 : 1 + (n - once) / sweep;
  }

  const ArrayJob job;
  const spec::Phases phases;
  std::vector<std::uint64_t> written; ///< cycles of a sweep until V shows, of each neuron
  std::uint64_t first = 0;            ///< cycles before the first phase
  std::uint64_t sweep = 0;
};

struct Bench {
  Bench(const std::string& name, const ArrayJob& job, systemc::Waking a_waking)
      : promise(job, a_waking), expected(run_slow_array(job, Keep::every_sweep)), waking(a_waking),
        dut(name.c_str(), job.array, job.topology) {
    dut.device.wake(waking);
  }
  std::string text() const {
    return describe(promise.job) + (waking == systemc::Waking::by_phase ? ", by phase" : ", by clock");
  }

  /// All that can be seen when n cycles have passed.
  void expect_at(std::uint64_t n) {
    const ArrayJob& job = promise.job;
    for (std::uint32_t i = 0; i < job.topology.neurons(); ++i) {
      const std::size_t times = std::min(promise.publications(i, n), expected.history.size());
      const std::int32_t v = times == 0 ? job.start[i] : expected.history[times - 1][i];
      ASSERT_EQ(dut.device.cells.state_raw(i), v) << "neuron " << i << " cycle " << n;
      changes += n > 0 && times > std::min(promise.publications(i, n - 1), expected.history.size()) &&
                 v != (times == 1 ? job.start[i] : expected.history[times - 2][i]);
    }
    const std::uint64_t run = promise.first + expected.sweeps * promise.sweep;
    const bool done = n >= run;
    ASSERT_EQ(dut.read(HM_REG_STATUS),
              std::uint32_t(!done                ? HM_STATUS_BUSY
                            : expected.converged ? HM_STATUS_DONE | HM_STATUS_CONVERGED
                                                 : HM_STATUS_DONE))
        << "cycle " << n << " of " << run;
    ASSERT_EQ(dut.irq.read(), done) << n;
    ASSERT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t(done ? HM_IRQ_DONE : 0)) << n;
    ASSERT_EQ(dut.read(HM_REG_SWEEPS), done ? expected.sweeps : 0) << n;
    ASSERT_EQ(dut.read(HM_REG_CYCLES_LO), done ? run : 0) << n;
    ASSERT_EQ(dut.read(HM_REG_LARGEST_CHANGE), done ? expected.largest_change : 0) << n;
    ASSERT_EQ(dut.read(HM_REG_LARGEST_SUM_LO), done ? static_cast<std::uint32_t>(expected.largest_sum) : 0)
        << n;
  }

  const Promise promise;
  const ArrayResult expected;
  const systemc::Waking waking;
  std::size_t changes = 0;
  Dut dut;
};

using Benches = std::vector<std::unique_ptr<Bench>>;

/// Starts all at once and looks at each after every cycle, a few beyond the last end.
inline void run_beside_each_other(const Benches& benches) {
  std::uint64_t last = 0;
  for (const auto& b : benches) {
    load(b->dut, b->promise.job);
    b->dut.write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
    b->dut.start(b->promise.job.threshold, b->promise.job.max_sweeps);
    last = std::max(last, b->promise.first + b->expected.sweeps * b->promise.sweep);
  }
  for (std::uint64_t n = 0; n <= last + 3; ++n) {
    benches[0]->dut.run_to_cycle(n);
    for (const auto& b : benches) {
      SCOPED_TRACE(b->text());
      b->expect_at(n);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  for (const auto& b : benches) EXPECT_GE(b->changes, b->promise.job.topology.neurons()) << b->text();
}

} // namespace hopmesh::tests
