// The clock-stepped engine beside the SystemC array woken by clock: every register of every neuron after
// every clock; and at the end of a run the engine's.
#include "sim/engine/clocked/clocked.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using engine::ClockedEngine;

const std::uint32_t* as_words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

template <typename Array> void load_codes(Array& array, const ArrayJob& job) {
  array.write_weights(0, as_words(job.weight), job.weight.size());
  array.write_biases(0, as_words(job.bias), job.bias.size());
  array.write_outputs(0, as_words(job.start), job.start.size());
}

void expect_sequencer(const ClockedEngine& e, const systemc::Sequencer& s) {
  ASSERT_EQ(e.segment(), s.segment());
  ASSERT_EQ(e.beat(), s.beat());
  ASSERT_EQ(e.busy(), s.busy());
  ASSERT_EQ(e.result().sweeps, s.sweeps());
  ASSERT_EQ(e.result().converged, s.converged());
}

void expect_registers(const ClockedEngine& e, const systemc::CellularArray& cells) {
  for (std::size_t k = 0; k < e.topology().neurons(); ++k) {
    SCOPED_TRACE("neuron " + std::to_string(k));
    const systemc::Neuron& n = cells.neuron(k);
    ASSERT_EQ(e.norm(k), n.accumulator.norm_raw());
    ASSERT_EQ(e.sum(k), n.accumulator.sum_raw());
    ASSERT_EQ(e.drive(k), n.output.drive_raw());
    ASSERT_EQ(e.change(k), n.output.change_raw());
    ASSERT_EQ(e.state(k), n.output.state_raw());
    const std::size_t per_cell = static_cast<std::size_t>(e.topology().neurons_per_cell);
    ASSERT_EQ(e.link(k), cells.cell(k / per_cell).out->wires()[k % per_cell]);
    ASSERT_EQ(e.reciprocal(k), n.output.reciprocal_raw());
  }
}

/// A run, clock by clock beside each other; returns how many clocks it took.
std::uint64_t expect_run_clock_by_clock(ClockedEngine& e, Dut& dut, const ArrayJob& job) {
  dut.write(HM_REG_IRQ_STATUS, ~0u);
  dut.start(job.threshold, job.max_sweeps);
  e.start(job.threshold, job.max_sweeps);
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

/// A run by the engine, and by the clocked one in strides.
void expect_end(const ClockedEngine& e, const ArrayJob& job, const std::vector<std::int32_t>& start,
                Dice& dice) {
  engine::Engine fast(job.array, job.topology, {1, "auto", 1});
  ClockedEngine strides(job.array, job.topology);
  load_codes(fast, job);
  load_codes(strides, job);
  fast.write_outputs(0, as_words(start), start.size());
  strides.write_outputs(0, as_words(start), start.size());
  const spec::Relaxation r = fast.run(job.threshold, job.max_sweeps);
  strides.start(job.threshold, job.max_sweeps);
  while (strides.busy()) strides.step(1 + dice.below(50));
  std::vector<std::int32_t> outputs(job.topology.neurons());
  fast.read_outputs(0, reinterpret_cast<std::uint32_t*>(outputs.data()), outputs.size());
  for (const spec::Relaxation& c : {e.result(), strides.result()}) {
    EXPECT_EQ(c.sweeps, r.sweeps);
    EXPECT_EQ(c.converged, r.converged);
    EXPECT_EQ(c.largest_change, r.largest_change);
    EXPECT_EQ(c.cycles, r.cycles);
  }
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    ASSERT_EQ(e.state(k), outputs[k]) << k;
    ASSERT_EQ(strides.state(k), outputs[k]) << k;
    ASSERT_EQ(strides.sum(k), e.sum(k)) << k;
    ASSERT_EQ(strides.drive(k), e.drive(k)) << k;
    ASSERT_EQ(strides.change(k), e.change(k)) << k;
    ASSERT_EQ(strides.norm(k), e.norm(k)) << k;
  }
}

void expect_alike(Dut& dut, const ArrayJob& job, Dice& dice, int runs) {
  SCOPED_TRACE(describe(job));
  dut.device.wake(systemc::Waking::by_clock);
  ClockedEngine e(job.array, job.topology);
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

class Clocked : public testing::TestWithParam<int> {};

/// Arrays of any kind.
TEST_P(Clocked, EqualsTheSystemcArrayAfterEveryClock) {
  const std::uint64_t first = 20000 + 12 * static_cast<std::uint64_t>(GetParam());
  std::vector<ArrayJob> jobs;
  std::vector<std::unique_ptr<Dut>> duts; // SystemC wants all of them before the first moves
  for (std::uint64_t seed = first; seed < first + 12; ++seed) {
    jobs.push_back(random_job(seed, 24));
    jobs.back().max_sweeps = 1 + static_cast<std::uint32_t>(seed % 3);
    const std::string name = "seed_" + std::to_string(seed);
    duts.push_back(std::make_unique<Dut>(name.c_str(), jobs.back().array, jobs.back().topology));
  }
  for (std::size_t k = 0; k < jobs.size() && !HasFailure(); ++k) {
    SCOPED_TRACE(duts[k]->name());
    Dice dice(first + k);
    expect_alike(*duts[k], jobs[k], dice, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Clocked, testing::Range(0, 10));

struct Kind {
  spec::Schedule schedule;
  spec::Normaliser normaliser;
  int lanes;
  bool exact;
  spec::Output output = spec::Output::modified;
  int per_cell = 3;
};

class ClockedKinds : public testing::TestWithParam<Kind> {};

std::string name_of_kind(const testing::TestParamInfo<Kind>& kind) {
  return std::string(spec::name_of(kind.param.schedule)) + "_" +
         std::string(spec::name_of(kind.param.normaliser)) + "_" + std::to_string(kind.param.lanes) +
         (kind.param.exact ? "_exact_" : "_rounding_") + std::string(spec::name_of(kind.param.output)) + "_" +
         std::to_string(kind.param.per_cell);
}

/// A grid so large that banks have several blocks of lanes and rows of three lengths.
TEST_P(ClockedKinds, EqualTheSystemcArrayOnAGrid) {
  Dice dice(30000);
  spec::ArraySpec array = spec::default_array();
  array.schedule = GetParam().schedule;
  array.normaliser = GetParam().normaliser;
  array.output = GetParam().output;
  array.lanes = GetParam().lanes;
  array.exact_accumulator = GetParam().exact;
  array.formats.accumulator = {24, 9, spec::Rounding::rnd_conv, spec::Overflow::sat};
  const bool one_by_one = array.schedule == spec::Schedule::sequential;
  const int n = GetParam().per_cell;
  ArrayJob job =
      lively_job(30001, array, one_by_one ? grid_topology(3, 4, true, n) : grid_topology(9, 11, true, n));
  job.max_sweeps = 2;
  Dut dut("grid", job.array, job.topology);
  expect_alike(dut, job, dice, 1);
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (int schedule = 0; schedule < 3; ++schedule)
    for (int normaliser = 0; normaliser < 3; ++normaliser)
      for (int lanes : {1, 2, 4, 5, 64})
        for (bool exact : {true, false})
          all.push_back({static_cast<spec::Schedule>(schedule), static_cast<spec::Normaliser>(normaliser),
                         lanes, exact});
  for (int schedule = 0; schedule < 3; ++schedule)
    for (int lanes : {1, 4})
      for (int per_cell : {1, 2})
        for (auto output : {spec::Output::modified, spec::Output::binary})
          all.push_back({static_cast<spec::Schedule>(schedule), spec::Normaliser::reciprocal, lanes, true,
                         output, per_cell});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, ClockedKinds, testing::ValuesIn(kinds()), name_of_kind);

TEST(ClockedEngine, StaysIdleWithoutStartAndAfterTheEnd) {
  ClockedEngine e(spec::default_array(), grid_topology(2, 2, true));
  e.step(10);
  EXPECT_EQ(e.segment(), spec::Segment::idle);
  EXPECT_FALSE(e.done());
  EXPECT_EQ(e.result().cycles, 0u);
  e.start(0, 0); // 0 sweeps are taken as 1
  e.step(UINT64_MAX);
  EXPECT_TRUE(e.done() && !e.busy());
  EXPECT_EQ(e.result().cycles, e.cycles().run(1));
  e.step();
  EXPECT_EQ(e.result().cycles, e.cycles().run(1));
}

} // namespace
} // namespace hopmesh::tests
