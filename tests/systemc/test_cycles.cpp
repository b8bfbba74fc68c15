// docs/hardware/cycles.md to the cycle: every V absent at n - 1 and present at n, DONE, the interrupt line
// and the counters likewise, for every schedule, normaliser, number of lanes and way of waking.
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Normaliser;
using spec::Schedule;
using systemc::Waking;

/// The page's table once more, by counting.
struct Promise {
  explicit Promise(const ArrayJob& j) : job(j), phases(spec::phases_of(j.topology, j.array.schedule)) {
    const bool binary = job.array.output == spec::Output::binary;
    const bool reciprocal = job.array.normaliser == Normaliser::reciprocal;
    std::uint64_t at = 0, longest = 0;
    for (const auto& phase : phases) {
      const std::uint64_t row = longest_row(phase);
      longest = std::max(longest, row);
      at += binary ? row + 2 : row + normalise() + 2;
      end.push_back(at);
    }
    sweep = at + 1;
    first = 1;
    if (binary) return;
    if (job.array.normaliser != Normaliser::prescaled) first += longest;
    if (reciprocal) first += job.array.reciprocal_bits + 1;
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
  std::uint64_t normalise() const {
    return job.array.normaliser == Normaliser::prescaled    ? 1
           : job.array.normaliser == Normaliser::reciprocal ? 2
                                                            : job.array.formats.drive.fraction_bits() + 2;
  }
  /// How often neuron i has published when n cycles have passed.
  std::size_t publications(std::uint32_t i, std::uint64_t n) const {
    std::size_t k = 0;
    while (std::find(phases[k].begin(), phases[k].end(), i) == phases[k].end()) ++k;
    const std::uint64_t once = first + end[k];
    return n < once ? 0 : 1 + (n - once) / sweep;
  }

  const ArrayJob job;
  const spec::Phases phases;
  std::vector<std::uint64_t> end; ///< of each phase, from the beginning of its sweep
  std::uint64_t first = 0;        ///< cycles before the first phase
  std::uint64_t sweep = 0;
};

struct Bench {
  Bench(const std::string& name, const ArrayJob& job, Waking a_waking)
      : promise(job), expected(run_slow_array(job, Keep::every_sweep)), waking(a_waking),
        dut(name.c_str(), job.array, job.topology) {
    dut.device.wake(waking);
  }
  std::string text() const {
    return describe(promise.job) + (waking == Waking::by_phase ? ", by phase" : ", by clock");
  }

  /// All that can be seen when n cycles have passed.
  void expect_at(std::uint64_t n) {
    const ArrayJob& job = promise.job;
    for (std::uint32_t i = 0; i < job.topology.neurons(); ++i) {
      const std::size_t times = std::min(promise.publications(i, n), expected.history.size());
      const std::int32_t v = times == 0 ? job.start[i] : expected.history[times - 1][i];
      ASSERT_EQ(dut.device.cells.neuron(i).output.state_raw(), v) << "neuron " << i << " cycle " << n;
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
  }

  const Promise promise;
  const ArrayResult expected;
  const Waking waking;
  std::size_t changes = 0;
  Dut dut;
};

using Benches = std::vector<std::unique_ptr<Bench>>;

/// Starts all at once and looks at each after every cycle, a few beyond the last end.
void run_beside_each_other(const Benches& benches) {
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

/// In place of a normaliser.
constexpr int binary = 3;

class ToTheCycle : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(ToTheCycle, OutputsDoneAndCountersChangeWhenPromised) {
  Benches benches;
  const auto [schedule, normaliser] = GetParam();
  // Rows of 6 to 15 taps: short rows wait for the longest of their phase.
  const spec::Topology star = topology_of(6, 3, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}});
  for (int lanes : {1, 2, 3, 7, 27})
    for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
      spec::ArraySpec array = spec::guarded_array();
      array.schedule = static_cast<Schedule>(schedule);
      array.normaliser = static_cast<Normaliser>(normaliser % 3);
      if (normaliser == binary) array.output = spec::Output::binary;
      array.lanes = lanes;
      ArrayJob job = lively_job(20 + lanes, array, star);
      job.max_sweeps = lanes == 27 ? 0 : 3; // 0 is taken as 1
      if (lanes == 7) job.max_sweeps = 2;
      if (lanes == 27) job.max_sweeps = 2;
      benches.push_back(std::make_unique<Bench>("dut" + std::to_string(benches.size()), job, waking));
    }
  run_beside_each_other(benches);
}

std::string names(const testing::TestParamInfo<std::tuple<int, int>>& param) {
  const auto [schedule, normaliser] = param.param;
  return std::string(spec::schedule_names[schedule]) + "_" +
         std::string(normaliser == binary ? "binary" : spec::normaliser_names[normaliser]);
}
INSTANTIATE_TEST_SUITE_P(All, ToTheCycle, testing::Combine(testing::Range(0, 3), testing::Range(0, 4)),
                         names);

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
