// Clock-stepped arrays beside SystemC arrays woken by clock: every register after every clock, and at the end
// of a run the engine's.
#pragma once

#include "rtl_model/systemc/cellular_array.h"
#include "rtl_model/systemc/folded_array.h"
#include "sim/engine/clocked/clocked.h"
#include "sim/engine/clocked/clocked_fold.h"
#include "sim/engine/engine.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

inline const std::uint32_t* as_words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

template <typename Array> void load_codes(Array& array, const ArrayJob& job) {
  array.write_weights(0, as_words(job.weight), job.weight.size());
  array.write_biases(0, as_words(job.bias), job.bias.size());
  array.write_outputs(0, as_words(job.start), job.start.size());
  array.write_momentum(0, as_words(job.momentum), job.momentum.size());
}

inline void expect_sequencer(const engine::ClockStepped& e, const systemc::Sequencer& s) {
  ASSERT_EQ(e.segment(), s.segment());
  ASSERT_EQ(e.beat(), s.beat());
  ASSERT_EQ(e.busy(), s.busy());
  ASSERT_EQ(e.result().sweeps, s.sweeps());
  ASSERT_EQ(e.result().converged, s.converged());
}

inline void expect_registers(const engine::ClockedEngine& e, const systemc::NeuronArray& array) {
  const auto& cells = dynamic_cast<const systemc::CellularArray&>(array);
  for (std::size_t k = 0; k < e.topology().neurons(); ++k) {
    SCOPED_TRACE("neuron " + std::to_string(k));
    const systemc::Neuron& n = cells.neuron(k);
    ASSERT_EQ(e.norm(k), n.accumulator.norm_raw());
    ASSERT_EQ(e.sum(k), n.accumulator.sum_raw());
    ASSERT_EQ(e.drive(k), n.output.drive_raw());
    ASSERT_EQ(e.change(k), n.output.change_raw());
    ASSERT_EQ(e.state(k), n.output.state_raw());
    ASSERT_EQ(e.link(k), cells.link_raw(k));
    ASSERT_EQ(e.reciprocal(k), n.output.reciprocal_raw());
    if (e.has_momentum()) {
      ASSERT_EQ(e.extrapolated(k), n.output.extrapolated_raw());
    }
  }
}

inline void expect_stage(const engine::ClockedFold& e, std::size_t number,
                         const systemc::PipelinedStage& stage) {
  ASSERT_EQ(e.drive(number), stage.output.drive_raw());
  ASSERT_EQ(e.change(number), stage.output.change_raw());
}

inline void expect_registers(const engine::ClockedFold& e, const systemc::NeuronArray& array) {
  const auto& folded = dynamic_cast<const systemc::FoldedArray&>(array);
  ASSERT_EQ(e.elements(), folded.elements().size());
  for (std::size_t k = 0; k < e.elements(); ++k) {
    SCOPED_TRACE("element " + std::to_string(k));
    const systemc::ProcessingElement& element = *folded.elements()[k];
    ASSERT_EQ(e.norm(k), element.accumulator.norm_raw());
    ASSERT_EQ(e.sum(k), element.accumulator.sum_raw());
    ASSERT_EQ(e.held(k), element.held());
    if (folded.shared_stage() == nullptr) expect_stage(e, k, element.stage());
  }
  if (folded.shared_stage()) expect_stage(e, 0, *folded.shared_stage());
  for (std::size_t k = 0; k < e.topology().neurons(); ++k) {
    SCOPED_TRACE("neuron " + std::to_string(k));
    ASSERT_EQ(e.state(k), folded.state_raw(k));
    ASSERT_EQ(e.link(k), folded.link_raw(k));
    ASSERT_EQ(e.reciprocal(k), folded.reciprocal_raw(k));
  }
}

/// A run, clock by clock beside each other; returns how many clocks it took.
template <typename Array> std::uint64_t expect_run_clock_by_clock(Array& e, Dut& dut, const ArrayJob& job) {
  dut.write(HM_REG_IRQ_STATUS, ~0u);
  dut.start(job.threshold, job.max_sweeps);
  e.start(job.threshold, job.max_sweeps, job.rule);
  std::uint64_t clock = 0;
  for (; !testing::Test::HasFatalFailure(); ++clock) {
    SCOPED_TRACE("after clock " + std::to_string(clock));
    dut.run_to_cycle(clock);
    expect_sequencer(e, dut.device.cells.sequencer);
    if (!testing::Test::HasFatalFailure()) expect_registers(e, dut.device.cells);
    if (!e.busy()) break;
    e.step();
  }
  sc_core::sc_start(dut.device.cells.period() * 0.75); // to an edge, where the next run may begin
  return clock;
}

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
