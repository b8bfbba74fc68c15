// docs/hardware/cycles.md to the cycle: every V absent at n - 1 and present at n, DONE, the interrupt line
// and the counters likewise, for every schedule, normaliser, number of lanes and way of waking.
#include "rtl_model/spec/presets.h"
#include "tests/systemc/cycle_bench.h"
#include "tests/systemc/stage_kinds.h"

namespace hopmesh::tests {
namespace {

using spec::Schedule;
using systemc::Waking;

class ToTheCycle : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(ToTheCycle, OutputsDoneAndCountersChangeWhenPromised) {
  Benches benches;
  const auto [schedule, kind] = GetParam();
  // Rows of 6 to 15 taps: short rows wait for the longest of their phase.
  const spec::Topology star = topology_of(6, 3, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}});
  for (int lanes : {1, 2, 3, 7, 27})
    for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
      spec::ArraySpec array = array_with(stage_kinds[kind], static_cast<Schedule>(schedule));
      array.lanes = lanes;
      ArrayJob job = lively_job(20 + lanes, array, star);
      job.max_sweeps = lanes == 27 ? 0 : 3; // 0 is taken as 1
      if (lanes == 7) job.max_sweeps = 2;
      if (lanes == 27) job.max_sweeps = 2;
      if (lanes == 3) job.rule = {true, 0, 1}; // LARGEST_SUM is told then
      benches.push_back(std::make_unique<Bench>("dut" + std::to_string(benches.size()), job, waking));
    }
  run_beside_each_other(benches);
}

std::string names(const testing::TestParamInfo<std::tuple<int, int>>& param) {
  const auto [schedule, kind] = param.param;
  return std::string(spec::schedule_names[schedule]) + "_" + stage_kinds[kind].name;
}
INSTANTIATE_TEST_SUITE_P(All, ToTheCycle, testing::ValuesIn(schedules_and_stages()), names);

TEST(Stops, ByThresholdByCountAndZeroIsOne) {
  Benches benches;
  const auto add = [&](std::uint32_t threshold, std::uint32_t sweeps) -> const ArrayResult& {
    for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
      ArrayJob job = lively_job(31, spec::descent_array(), grid_topology(2, 3, true));
      job.threshold = threshold;
      job.max_sweeps = sweeps;
      benches.push_back(std::make_unique<Bench>("dut" + std::to_string(benches.size()), job, waking));
    }
    return benches.back()->expected;
  };
  const ArrayResult free = add(0, 6);
  ASSERT_FALSE(free.converged);
  ArrayJob three = lively_job(31, spec::descent_array(), grid_topology(2, 3, true));
  three.max_sweeps = 3;
  const std::uint32_t change = run_slow_array(three).largest_change;
  const auto& reached = add(change, 6); // equal to the threshold is small enough ...
  EXPECT_TRUE(reached.converged);
  EXPECT_EQ(reached.sweeps, 3u);
  EXPECT_NE(add(change - 1, 6).sweeps, 3u); // ... and one more is not
  EXPECT_FALSE(add(change - 1, 3).converged);
  EXPECT_TRUE(add(change, 3).converged); // both at once
  run_beside_each_other(benches);
}

TEST(Stops, ZeroSweepsAreTakenAsOne) {
  for (std::uint32_t sweeps : {0u, 1u}) {
    static std::vector<std::unique_ptr<Bench>> keep;
    ArrayJob job = lively_job(32, spec::descent_array(), ring_topology(5));
    job.max_sweeps = sweeps;
    keep.push_back(std::make_unique<Bench>("dut" + std::to_string(sweeps), job, Waking::by_clock));
    EXPECT_EQ(keep.back()->expected.sweeps, 1u);
    if (keep.size() == 2)
      for (const auto& b : keep) {
        load(b->dut, b->promise.job);
        b->dut.start(0, b->promise.job.max_sweeps);
        b->dut.run_until_done();
        EXPECT_EQ(b->dut.read(HM_REG_CYCLES_LO), b->promise.first + b->promise.sweep);
        EXPECT_EQ(b->dut.codes(Window::OUTPUT, 15), b->expected.output());
      }
  }
}

/// A START that comes between two edges is taken at the next one, and one on an edge at once.
TEST(Alignment, StartIsTakenAtTheNextEdge) {
  struct Case {
    double now, delay, edge; // in nanoseconds; a cycle has 10
  };
  const std::vector<Case> cases{{0, 0, 0},  {0, 10, 10}, {0, 1, 10},         {0, 9.999, 10},    {3, 0, 10},
                                {3, 7, 10}, {3, 8, 20},  {9.999, 0.001, 10}, {9.999, 0.002, 20}};
  Benches benches;
  for (std::size_t k = 0; k < 2 * cases.size(); ++k)
    benches.push_back(std::make_unique<Bench>("dut" + std::to_string(k),
                                              lively_job(33, spec::byte_array(), ring_topology(3)),
                                              k % 2 ? Waking::by_clock : Waking::by_phase));
  Dut::elaborate();
  const auto ns = [](double t) { return sc_core::sc_time(t, sc_core::SC_NS); };
  const auto until = [](sc_core::sc_time t) { sc_core::sc_start(t - sc_core::sc_time_stamp()); };
  for (std::size_t k = 0; k < benches.size(); ++k) {
    const Case& c = cases[k / 2];
    Bench& b = *benches[k];
    load(b.dut, b.promise.job);
    b.dut.write(HM_REG_MAX_SWEEPS, 1);
    const auto base = ns(10000.0 * (static_cast<double>(k) + 1)); // an edge
    until(base + ns(c.now));
    tlm::tlm_generic_payload payload;
    std::uint32_t start = HM_CONTROL_START;
    payload.set_command(tlm::TLM_WRITE_COMMAND);
    payload.set_address(HM_REG_CONTROL);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&start));
    payload.set_data_length(4);
    payload.set_streaming_width(4);
    sc_core::sc_time delay = ns(c.delay);
    b.dut.socket->b_transport(payload, delay); // adds two cycles of the bus
    const auto done = base + ns(c.edge + 20 + 10.0 * static_cast<double>(slow_cycles(b.promise.job, 1)));
    until(done - ns(0.001));
    EXPECT_EQ(b.dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY}) << k;
    until(done + ns(0.001));
    EXPECT_NE(b.dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY}) << k;
  }
}

} // namespace
} // namespace hopmesh::tests
