// Where a run by clocks ends: as the engine's, in whatever strides it was walked.
#pragma once

#include "tests/engine/clocked_pair.h"

namespace hopmesh::tests {

inline void expect_same_probes(const engine::ClockStepped& a, const engine::ClockStepped& b) {
  std::vector<std::size_t> cells(a.topology().cells());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = c;
  const auto one = a.probes(cells), other = b.probes(cells);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k)
    ASSERT_EQ(one[k].code(), other[k].code()) << one[k].scopes.front() << " " << one[k].signal.name;
}

/// A run by the engine, and by the clocked one in strides.
template <typename Array>
void expect_end(const Array& e, const ArrayJob& job, const std::vector<std::int32_t>& start, Dice& dice) {
  engine::Engine fast(job.array, job.topology, {1, "auto", 1});
  Array strides(job.array, job.topology);
  load_codes(fast, job);
  load_codes(strides, job);
  fast.write_outputs(0, as_words(start), start.size());
  strides.write_outputs(0, as_words(start), start.size());
  const spec::Relaxation r = fast.run(job.threshold, job.max_sweeps, job.rule);
  strides.start(job.threshold, job.max_sweeps, job.rule);
  while (strides.busy()) strides.step(1 + dice.below(50));
  std::vector<std::int32_t> outputs(job.topology.neurons());
  fast.read_outputs(0, reinterpret_cast<std::uint32_t*>(outputs.data()), outputs.size());
  for (const spec::Relaxation& c : {e.result(), strides.result()}) {
    EXPECT_EQ(c.sweeps, r.sweeps);
    EXPECT_EQ(c.converged, r.converged);
    EXPECT_EQ(c.largest_change, r.largest_change);
    EXPECT_EQ(c.largest_sum, r.largest_sum);
    EXPECT_EQ(c.cycles, r.cycles);
  }
  for (std::size_t k = 0; k < outputs.size(); ++k) ASSERT_EQ(e.state(k), outputs[k]) << k;
  expect_same_probes(strides, e);
}

template <typename Array> void expect_runs_alike(Dut& dut, const ArrayJob& job, Dice& dice, int runs) {
  Array e(job.array, job.topology);
  load(dut, job);
  load_codes(e, job);
  for (int run = 0; run < runs && !testing::Test::HasFailure();
       ++run) { // what a run leaves behind counts too
    std::vector<std::int32_t> start;
    for (std::size_t k = 0; k < job.topology.neurons(); ++k) start.push_back(e.state(k));
    const std::uint64_t clocks = expect_run_clock_by_clock(e, dut, job);
    EXPECT_EQ(clocks, e.result().cycles);
    if (!testing::Test::HasFailure()) expect_end(e, job, start, dice);
  }
}

inline void expect_alike(Dut& dut, const ArrayJob& job, Dice& dice, int runs) {
  SCOPED_TRACE(describe(job));
  dut.device.wake(systemc::Waking::by_clock);
  if (spec::is_folded(job.array))
    expect_runs_alike<engine::ClockedFold>(dut, job, dice, runs);
  else
    expect_runs_alike<engine::ClockedEngine>(dut, job, dice, runs);
}

} // namespace hopmesh::tests
