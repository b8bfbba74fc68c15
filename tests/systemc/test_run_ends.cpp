// Where one run ends and the next begins: START at every instant around DONE, refused commands, the interrupt
// line, RESET and START in one write, and arrays too small to hide behind.
#include "rtl_model/spec/presets.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using systemc::Waking;
using Words = std::vector<std::int32_t>;

const spec::Topology ring = ring_topology(4);

/// Time from now to the next clock edge, where a test wants a run to begin without a gap.
void wait_for_edge(const Dut& dut) {
  const auto period = dut.device.cells.period();
  sc_core::sc_start(period - sc_core::sc_time_stamp() % period);
}

/// Beside a device: asks for a run at a given instant, delta by delta until it is taken, then watches.
class Presser : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Presser);
  Presser(sc_core::sc_module_name name, const std::vector<Dut*>& duts) : sc_module(name), duts_(duts) {
    SC_METHOD(press);
    sensitive << press_;
    dont_initialize();
  }
  void press_at(sc_core::sc_time when) { press_.notify(when - sc_core::sc_time_stamp()); }

  int presses = 0;
  bool taken = false;
  sc_core::sc_time taken_at;

 private:
  void press() {
    Dut& dut = *duts_.front();
    ++presses;
    dut.write(HM_REG_IRQ_STATUS, ~0u);
    dut.write(HM_REG_CONTROL, HM_CONTROL_START);
    taken = (dut.read(HM_REG_IRQ_STATUS) & HM_IRQ_REFUSED) == 0;
    taken_at = sc_core::sc_time_stamp();
    dut.write(HM_REG_IRQ_STATUS, ~0u);
    if (!taken && presses < 20) press_.notify(sc_core::SC_ZERO_TIME);
  }

  const std::vector<Dut*>& duts_;
  sc_core::sc_event press_;
};

class AroundDone : public testing::TestWithParam<std::tuple<Waking, bool>> {};

/// Whichever process of that instant runs first, DONE of the first run never speaks for the second.
TEST_P(AroundDone, StartInThatVeryInstantIsRefusedOrARunOfItsOwn) {
  const auto [waking, before_device] = GetParam();
  const ArrayJob job = lively_job(5, small_array(), ring);
  std::vector<Dut*> duts;
  std::unique_ptr<Presser> presser;
  if (before_device) presser = std::make_unique<Presser>("presser", duts);
  Dut dut("dut", job.array, job.topology);
  if (!before_device) presser = std::make_unique<Presser>("presser", duts);
  duts.push_back(&dut);
  dut.device.wake(waking);
  load(dut, job);

  const auto period = dut.device.cells.period();
  dut.start(0, 2);
  const auto started = sc_core::sc_time_stamp() + dut.last_delay;
  const double run = static_cast<double>(slow_cycles(job, 2));
  presser->press_at(started + period * run);
  sc_core::sc_start(started + period * (run + 0.25) - sc_core::sc_time_stamp());
  ASSERT_TRUE(presser->taken) << presser->presses;
  EXPECT_EQ(presser->taken_at, started + period * run);

  const double taken = run + 2; // the transfer of START itself
  for (double n = run; n < taken + run; n += 1) {
    ASSERT_EQ(dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY}) << n;
    ASSERT_EQ(dut.read(HM_REG_IRQ_STATUS), 0u) << n;
    ASSERT_EQ(dut.read(HM_REG_SWEEPS), 2u) << n;
    sc_core::sc_start(period);
  }
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_DONE});
  EXPECT_EQ(dut.read(HM_REG_CYCLES_LO), slow_cycles(job, 2));
  ArrayJob both = job;
  both.max_sweeps = 4;
  EXPECT_EQ(dut.codes(Window::OUTPUT, ring.neurons()), run_slow_array(both).output());
}

std::string order_name(const testing::TestParamInfo<std::tuple<Waking, bool>>& param) {
  const auto [waking, before_device] = param.param;
  return std::string(waking == Waking::by_phase ? "ByPhase" : "ByClock") +
         (before_device ? "BeforeTheDevice" : "AfterTheDevice");
}
INSTANTIATE_TEST_SUITE_P(Order, AroundDone,
                         testing::Combine(testing::Values(Waking::by_phase, Waking::by_clock),
                                          testing::Bool()),
                         order_name);

class Ends : public testing::TestWithParam<Waking> {
 protected:
  Ends() : job(lively_job(6, small_array(), ring)), dut("dut", job.array, job.topology) {
    dut.device.wake(GetParam());
    load(dut, job);
  }
  Words output() { return dut.codes(Window::OUTPUT, ring.neurons()); }
  Words expected(std::uint32_t sweeps) {
    ArrayJob longer = job;
    longer.max_sweeps = sweeps;
    return run_slow_array(longer).output();
  }

  ArrayJob job;
  Dut dut;
};

TEST_P(Ends, RunsFollowEachOtherAtOnce) {
  for (std::uint32_t k = 1; k <= 5; ++k) {
    dut.start(0, 1);
    const std::uint64_t run = slow_cycles(job, 1);
    dut.run_to_cycle(run - 1);
    ASSERT_EQ(dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY}) << k;
    dut.run_to_cycle(run);
    ASSERT_EQ(dut.read(HM_REG_STATUS) & HM_STATUS_DONE, std::uint32_t{HM_STATUS_DONE}) << k;
    ASSERT_EQ(dut.read(HM_REG_CYCLES_LO), run);
    ASSERT_EQ(output(), expected(k));
    wait_for_edge(dut);
  }
}

TEST_P(Ends, CommandsDuringARunAreRefusedAndHarmless) {
  dut.write(HM_REG_IRQ_ENABLE, HM_IRQ_REFUSED);
  dut.start(0, 3);
  const std::uint64_t run = slow_cycles(job, 3);
  for (std::uint32_t command : {1u, 2u, 3u}) {
    dut.run_to_cycle(20 * command);
    EXPECT_EQ(dut.write(HM_REG_CONTROL, command), tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_REFUSED});
    dut.run_to_cycle(20 * command + 3);
    EXPECT_TRUE(dut.irq.read());
    dut.write(HM_REG_IRQ_STATUS, HM_IRQ_REFUSED);
    dut.run_to_cycle(20 * command + 6);
    EXPECT_FALSE(dut.irq.read());
  }
  dut.run_to_cycle(run - 1);
  EXPECT_EQ(dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY});
  dut.run_to_cycle(run);
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_DONE});
  EXPECT_FALSE(dut.irq.read()); // DONE was not enabled
  EXPECT_EQ(output(), expected(3));
}

TEST_P(Ends, TheLineIsEnabledCausesAndNothingElse) {
  for (std::uint32_t enable = 0; enable < 4; ++enable) {
    dut.write(HM_REG_IRQ_ENABLE, enable);
    wait_for_edge(dut);
    dut.start(0, 1);
    dut.run_to_cycle(slow_cycles(job, 1) + 1);
    EXPECT_EQ(dut.irq.read(), (enable & HM_IRQ_DONE) != 0);
    dut.write(HM_REG_IRQ_ENABLE, 0);
    sc_core::sc_start(dut.device.cells.period() * 3);
    EXPECT_FALSE(dut.irq.read());
    dut.write(HM_REG_IRQ_ENABLE, enable);
    sc_core::sc_start(dut.device.cells.period() * 3);
    EXPECT_EQ(dut.irq.read(), (enable & HM_IRQ_DONE) != 0);
    dut.write(HM_REG_IRQ_STATUS, ~0u);
    sc_core::sc_start(dut.device.cells.period() * 3);
    EXPECT_FALSE(dut.irq.read());
  }
}

TEST_P(Ends, ResetAndStartInOneWriteRunAnEmptyNetwork) {
  dut.write(HM_REG_MAX_SWEEPS, 9);
  dut.write(HM_REG_CONTROL, HM_CONTROL_RESET | HM_CONTROL_START);
  dut.run_until_done();
  EXPECT_EQ(output(), Words(ring.neurons(), 0));
  EXPECT_EQ(dut.read(HM_REG_MAX_SWEEPS), 1u);
  EXPECT_EQ(dut.read(HM_REG_SWEEPS), 1u);
  EXPECT_EQ(dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_DONE | HM_STATUS_CONVERGED});
  EXPECT_EQ(dut.read(HM_REG_LARGEST_CHANGE), 0u);
  EXPECT_EQ(dut.read(HM_REG_CYCLES_LO), slow_cycles(job, 1));
  load(dut, job); // and it still works
  dut.start(0, 3);
  dut.run_until_done();
  EXPECT_EQ(output(), expected(3));
}

TEST_P(Ends, NothingMovesAndTheClockRestsLowBetweenRuns) {
  for (int k = 0; k < 3; ++k) {
    dut.start(0, 1);
    dut.run_to_cycle(slow_cycles(job, 1) + 1);
    EXPECT_FALSE(dut.device.cells.sequencer.clock().read());
    EXPECT_EQ(dut.device.cells.sequencer.segment(), spec::Segment::idle);
    EXPECT_FALSE(sc_core::sc_pending_activity());
    wait_for_edge(dut);
  }
}

TEST_P(Ends, ANewBiasOrWeightChangesTheNormOfTheNextRun) {
  dut.start(0, 1);
  dut.run_until_done();
  ArrayJob next = job;
  next.start = output();
  for (auto& w : next.weight) w /= 3;
  for (auto& b : next.bias) b = -b;
  next.max_sweeps = 2;
  load(dut, next);
  dut.start(0, 2);
  dut.run_until_done();
  EXPECT_EQ(output(), run_slow_array(next).output());
}

TEST_P(Ends, AWalkWindowOrWakingMayChangeBetweenRuns) {
  for (std::uint32_t k = 1; k <= 4; ++k) {
    dut.device.wake(k % 2 ? Waking::by_clock : Waking::by_phase);
    dut.start(0, 1);
    dut.run_until_done();
    ASSERT_EQ(output(), expected(k));
  }
}

std::string waking_name(const testing::TestParamInfo<Waking>& param) {
  return param.param == Waking::by_phase ? "ByPhase" : "ByClock";
}
INSTANTIATE_TEST_SUITE_P(Wake, Ends, testing::Values(Waking::by_phase, Waking::by_clock), waking_name);

/// A single cell, cells without links, rows of zeros (N = 0): in every normaliser, both ways of waking.
TEST(SmallArrays, EmptyRowsKeepVAndLoneCellsRelax) {
  std::vector<std::unique_ptr<Dut>> duts;
  std::vector<ArrayJob> jobs;
  for (int normaliser = 0; normaliser < 3; ++normaliser)
    for (std::size_t cells : {1u, 3u})
      for (int per_cell : {1, 2, 3})
        for (bool empty : {false, true})
          for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
            spec::ArraySpec array = spec::guarded_array();
            array.normaliser = static_cast<spec::Normaliser>(normaliser);
            ArrayJob job = lively_job(9, array, topology_of(cells, per_cell, {}));
            if (empty) std::fill(job.weight.begin(), job.weight.end(), 0);
            if (empty) std::fill(job.bias.begin(), job.bias.end(), 0);
            const std::string name = "dut" + std::to_string(duts.size());
            duts.push_back(std::make_unique<Dut>(name.c_str(), array, job.topology));
            duts.back()->device.wake(waking);
            jobs.push_back(job);
          }
  for (std::size_t k = 0; k < duts.size(); ++k) {
    SCOPED_TRACE(describe(jobs[k]));
    load(*duts[k], jobs[k]);
    duts[k]->start(0, 3);
    duts[k]->run_until_done();
    const ArrayResult expected = run_slow_array(jobs[k]);
    const Words output = duts[k]->codes(Window::OUTPUT, jobs[k].topology.neurons());
    EXPECT_EQ(output, expected.output());
    EXPECT_EQ(duts[k]->read(HM_REG_CYCLES_LO), expected.cycles);
    EXPECT_EQ(output == jobs[k].start, expected.sweeps == 1); // empty rows converge at once
    EXPECT_EQ(jobs[k].weight[0] == 0, expected.sweeps == 1);
  }
}

} // namespace
} // namespace hopmesh::tests
