// RESET with its cycles, ABORT at every kind of moment, the interrupt test, DONE and a clearing write in one
// instant, and codes that share words: docs/hardware/registers.md, to the cycle.
#include "rtl_model/spec/presets.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using systemc::Waking;
using Words = std::vector<std::int32_t>;

constexpr std::uint32_t busy = HM_STATUS_BUSY, done = HM_STATUS_DONE, aborted = HM_STATUS_ABORTED,
                        converged = HM_STATUS_CONVERGED;

/// Rows of 9 taps, on one multiplier.
const spec::Topology ring = ring_topology(4);

class Commands : public testing::TestWithParam<Waking> {
 protected:
  Commands() : job(lively_job(6, small_array(), ring)), dut("dut", job.array, job.topology) {
    dut.device.wake(GetParam());
    load(dut, job);
  }
  std::uint32_t status() { return dut.read(HM_REG_STATUS); }
  Words output() { return dut.codes(Window::OUTPUT, ring.neurons()); }
  Words expected(std::uint32_t sweeps) {
    ArrayJob longer = job;
    longer.max_sweeps = sweeps;
    return run_slow_array(longer).output();
  }
  std::uint64_t cycles(std::uint32_t sweeps) const { return slow_cycles(job, sweeps); }

  ArrayJob job;
  Dut dut;
};

TEST_P(Commands, ResetTakesACycleForEachTapOfTheLongestRow) {
  dut.command(HM_CONTROL_RESET);
  for (std::uint64_t n = 0; n < 9; ++n) {
    dut.run_to_cycle(n);
    ASSERT_EQ(status(), busy) << n;
    ASSERT_EQ(dut.transfer(tlm::TLM_READ_COMMAND, dut.at(Window::BIAS), &job.bias[0], 4),
              tlm::TLM_COMMAND_ERROR_RESPONSE);
  }
  dut.run_to_cycle(9);
  EXPECT_EQ(status(), 0u);
  EXPECT_EQ(output(), Words(ring.neurons(), 0));
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), 0u);
  EXPECT_FALSE(sc_core::sc_pending_activity());
}

TEST_P(Commands, StartWithResetRunsBehindIt) {
  dut.command(HM_CONTROL_RESET | HM_CONTROL_START);
  const std::uint64_t run = cycles(1);
  dut.run_to_cycle(9 + run - 1);
  EXPECT_EQ(status(), busy);
  dut.run_to_cycle(9 + run);
  EXPECT_EQ(status(), done | converged);
  EXPECT_EQ(dut.read(HM_REG_CYCLES_LO), run); // of the run alone
}

TEST_P(Commands, NothingInterruptsAReset) {
  for (std::uint32_t command : {1u, 2u, 3u, 4u, 5u, 6u, 7u}) {
    dut.command(HM_CONTROL_RESET);
    dut.run_to_cycle(4);
    dut.write(HM_REG_CONTROL, command);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_REFUSED}) << command;
    dut.run_to_cycle(8);
    EXPECT_EQ(status(), busy) << command;
    dut.run_to_cycle(9);
    EXPECT_EQ(status(), 0u) << command;
    dut.run_to_cycle(200);
    EXPECT_EQ(status(), 0u) << command;
  }
}

/// A run that waits behind a RESET is aborted no sooner than it has begun.
TEST_P(Commands, AbortIsForTheRunOnceTheResetIsOver) {
  for (const std::uint64_t at : {8u, 9u}) {
    dut.command(HM_CONTROL_RESET | HM_CONTROL_START);
    dut.run_to_cycle(at);
    dut.write(HM_REG_CONTROL, HM_CONTROL_ABORT);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t(at == 8 ? HM_IRQ_REFUSED : 0));
    dut.run_to_cycle(9 + cycles(1));
    EXPECT_EQ(status(), done | converged | (at == 8 ? 0 : aborted));
    dut.run_to_cycle(10 + cycles(1));
  }
}

TEST_P(Commands, AbortEndsTheRunWithTheSweepAtHand) {
  const std::uint64_t sweep = cycles(2) - cycles(1);
  std::uint32_t before = 0;
  // The first and last cycle of a run's beginning, of a sweep, and of its check.
  for (const auto& [at, sweeps] : std::vector<std::pair<std::uint64_t, std::uint32_t>>{{0, 1},
                                                                                       {1, 1},
                                                                                       {cycles(1) - 1, 1},
                                                                                       {cycles(1), 2},
                                                                                       {cycles(1) + 1, 2},
                                                                                       {cycles(2) - 1, 2},
                                                                                       {cycles(2), 3},
                                                                                       {cycles(3) - 1, 3}}) {
    dut.write(HM_REG_IRQ_STATUS, ~0u);
    dut.write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
    dut.start(0, 9);
    dut.run_to_cycle(at);
    EXPECT_EQ(dut.write(HM_REG_CONTROL, HM_CONTROL_ABORT), tlm::TLM_OK_RESPONSE);
    dut.run_to_cycle(cycles(sweeps) - 1);
    ASSERT_EQ(status(), busy) << at;
    dut.run_to_cycle(cycles(sweeps));
    ASSERT_EQ(status(), done | aborted) << at;
    EXPECT_TRUE(dut.irq.read());
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_DONE});
    EXPECT_EQ(dut.read(HM_REG_SWEEPS), sweeps);
    EXPECT_EQ(dut.read(HM_REG_CYCLES_LO), cycles(sweeps));
    before += sweeps;
    ASSERT_EQ(output(), expected(before)) << at;
    dut.run_to_cycle(cycles(sweeps) + sweep + 1);
    EXPECT_EQ(status(), done | aborted) << at;
  }
  dut.start(0, 1); // and nothing of it is left
  dut.run_until_done();
  EXPECT_EQ(status(), done);
}

TEST_P(Commands, AnAbortedRunMayConvergeAllTheSame) {
  dut.start(~0u, 9);
  dut.run_to_cycle(3);
  dut.write(HM_REG_CONTROL, HM_CONTROL_ABORT);
  dut.run_until_done();
  EXPECT_EQ(status(), done | aborted | converged);
}

TEST_P(Commands, AbortWhileIdleChangesNothing) {
  for (int after_a_run = 0; after_a_run < 2; ++after_a_run) {
    const std::uint32_t before = status(), causes = dut.read(HM_REG_IRQ_STATUS);
    const Words outputs = output();
    EXPECT_EQ(dut.write(HM_REG_CONTROL, HM_CONTROL_ABORT), tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(status(), before);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), causes);
    EXPECT_EQ(output(), outputs);
    dut.write(HM_REG_MAX_SWEEPS, 2);
    dut.write(HM_REG_CONTROL,
              HM_CONTROL_START | HM_CONTROL_ABORT); // of this run there is nothing to abort yet
    dut.run_until_done();
    EXPECT_EQ(status(), done);
    EXPECT_EQ(dut.read(HM_REG_SWEEPS), 2u);
  }
}

TEST_P(Commands, AbortAndStartInOneWordEndOneRunAndRefuseAnother) {
  dut.start(0, 9);
  dut.run_to_cycle(3);
  dut.write(HM_REG_CONTROL, HM_CONTROL_START | HM_CONTROL_ABORT);
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_REFUSED});
  dut.run_to_cycle(cycles(1));
  EXPECT_EQ(status(), done | aborted);
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_REFUSED | HM_IRQ_DONE});
}

/// The windows are being written when START comes: what was written by then counts, and the rest is refused.
TEST_P(Commands, StartBetweenTwoBurstsRunsOnWhatWasWrittenByThen) {
  ArrayJob half = job;
  const std::size_t cut = 50;
  for (std::size_t k = 0; k < cut; ++k) half.weight[k] /= 2;
  dut.write(dut.at(Window::WEIGHT), Words(half.weight.begin(), half.weight.begin() + cut));
  dut.start(0, 2);
  EXPECT_EQ(dut.write(dut.at(Window::WEIGHT) + 4 * cut, Words(20, 7)), tlm::TLM_COMMAND_ERROR_RESPONSE);
  dut.run_until_done();
  half.max_sweeps = 2;
  EXPECT_EQ(output(), run_slow_array(half).output());
  EXPECT_EQ(dut.codes(Window::WEIGHT, half.weight.size()), half.weight);
}

TEST_P(Commands, AnInterruptCanBeTested) {
  for (std::uint32_t enable = 0; enable < 4; ++enable)
    for (std::uint32_t test = 0; test < 4; ++test) {
      dut.write(HM_REG_IRQ_STATUS, ~0u);
      dut.write(HM_REG_IRQ_ENABLE, enable);
      EXPECT_EQ(dut.write(HM_REG_IRQ_TEST, test | 0xFFFFFFF0), tlm::TLM_OK_RESPONSE);
      EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), test);
      EXPECT_EQ(dut.read(HM_REG_IRQ_TEST), 0u);
      sc_core::sc_start(dut.device.cells.period() * 3);
      EXPECT_EQ(dut.irq.read(), (enable & test) != 0);
      dut.write(HM_REG_IRQ_TEST, 0); // sets nothing, and clears nothing
      EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), test);
    }
}

/// Whoever clears DONE as it rises does not lose it: hardware wins.
TEST_P(Commands, DoneThatRisesWhileItIsClearedStays) {
  const std::uint64_t run = cycles(1);
  dut.start(0, 1);
  dut.run_to_cycle(run - 1);
  dut.write(HM_REG_IRQ_STATUS, HM_IRQ_DONE); // holds the bus in the cycles run - 1 and run
  dut.run_to_cycle(run);
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_DONE});
  dut.write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
  EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), 0u);
}

std::string waking_name(const testing::TestParamInfo<Waking>& param) {
  return param.param == Waking::by_phase ? "ByPhase" : "ByClock";
}
INSTANTIATE_TEST_SUITE_P(Wake, Commands, testing::Values(Waking::by_phase, Waking::by_clock), waking_name);

/// The longest row, in groups of lanes.
TEST(ResetCycles, AreThoseOfTheDeepestMemory) {
  std::vector<std::unique_ptr<Dut>> duts;
  const std::vector<std::pair<int, std::uint64_t>> cases{{1, 15}, {2, 8}, {4, 4}, {15, 1}, {64, 1}};
  const spec::Topology star = topology_of(5, 3, {{0, 1}, {0, 2}, {0, 3}, {0, 4}}); // rows of 6 and 15 taps
  for (const auto& [lanes, n] : cases) {
    spec::ArraySpec array = small_array();
    array.lanes = lanes;
    duts.push_back(std::make_unique<Dut>(("dut" + std::to_string(lanes)).c_str(), array, star));
  }
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::uint64_t n = cases[k].second;
    duts[k]->command(HM_CONTROL_RESET);
    duts[k]->run_to_cycle(n - 1);
    EXPECT_EQ(duts[k]->read(HM_REG_STATUS), busy) << n;
    duts[k]->run_to_cycle(n);
    EXPECT_EQ(duts[k]->read(HM_REG_STATUS), 0u) << n;
  }
}

/// Words written one way read back as the codes that stand in them: 4, 2 or 1 a word, by width.
TEST(Packing, PutsCodesSideBySideFromTheLowEndOn) {
  spec::ArraySpec array = spec::byte_array(); // weight and state of 8 bits, bias of 12
  array.packing = true;
  const spec::Topology two = topology_of(2, 1, {}); // two weights, two biases, two outputs
  Dut dut("dut", array, two);
  EXPECT_EQ(dut.read(HM_REG_CAP_PACKING), 0x01040402u);
  EXPECT_EQ(dut.read(HM_REG_CAP_WEIGHT_WORDS), 1u);
  dut.write(dut.at(Window::WEIGHT), 0xAABB80FFu); // the upper half belongs to no code
  EXPECT_EQ(dut.read(dut.at(Window::WEIGHT)), 0x000080FFu);
  EXPECT_EQ(dut.codes(Window::WEIGHT, 2), (Words{-1, -128}));
  dut.write(dut.at(Window::BIAS), 0xF7FF1FFFu); // twelve bits of each half count
  EXPECT_EQ(dut.codes(Window::BIAS, 2), (Words{-1, 2047}));
  EXPECT_EQ(dut.read(dut.at(Window::BIAS)), 0x07FFFFFFu);
  dut.write(dut.at(Window::OUTPUT), 0x0000407Fu); // held within ±1.0, which is 64
  EXPECT_EQ(dut.codes(Window::OUTPUT, 2), (Words{64, 64}));
  EXPECT_EQ(dut.transfer(tlm::TLM_READ_COMMAND, dut.at(Window::WEIGHT) + 4, &array, 4),
            tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

TEST(Packing, LeavesWideCodesAsTheyAre) {
  spec::ArraySpec array = spec::guarded_array(); // weight of 16 bits, bias and state of 24
  array.packing = true;
  Dut dut("dut", array, ring);
  EXPECT_EQ(dut.read(HM_REG_CAP_PACKING), 0x01020101u);
  EXPECT_EQ(dut.read(HM_REG_CAP_WEIGHT_WORDS), 54u); // of 108 weights
  Words weights(108), biases(12);
  for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = static_cast<std::int32_t>(k * 601) - 32000;
  for (std::size_t k = 0; k < biases.size(); ++k)
    biases[k] = static_cast<std::int32_t>(k * 1000003) - 8000000;
  EXPECT_EQ(dut.put_codes(Window::WEIGHT, weights), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(dut.put_codes(Window::BIAS, biases), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(dut.codes(Window::WEIGHT, 108), weights);
  EXPECT_EQ(dut.read(dut.at(Window::BIAS), 12), biases);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t tap = 0; tap < 9; ++tap)
      ASSERT_EQ(dut.device.cells.weight(i, tap), weights[9 * i + tap]);
}

} // namespace
} // namespace hopmesh::tests
