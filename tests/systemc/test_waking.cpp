// Woken by phase, by clock, or now this way and now that: the same bits, the same counters, at the same
// times. Times are not sampled: simulation is led from event to event, and every change of a V is noted with
// its time.
#include "rtl_model/spec/presets.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using systemc::CycleWindow;

/// A device with the diary of what its outputs and its interrupt line did, and when.
struct Watched {
  struct Entry {
    std::uint64_t picoseconds;
    std::size_t what; ///< a neuron; or the interrupt line, behind the last one
    std::int64_t value;
    bool operator==(const Entry& o) const {
      return picoseconds == o.picoseconds && what == o.what && value == o.value;
    }
  };

  Watched(const std::string& name, const ArrayJob& job) : dut(name.c_str(), job.array, job.topology) {}

  void look() {
    const std::size_t neurons = dut.device.cells.topology().neurons();
    seen.resize(neurons + 1, 0);
    for (std::size_t i = 0; i <= neurons; ++i) {
      const std::int64_t v = i < neurons ? dut.device.cells.state_raw(i) : std::int64_t{dut.irq.read()};
      if (v != seen[i]) diary.push_back({sc_core::sc_time_stamp().value(), i, v});
      seen[i] = v;
    }
  }
  std::vector<std::uint32_t> counters() {
    std::vector<std::uint32_t> words;
    for (std::uint32_t r : {HM_REG_STATUS, HM_REG_SWEEPS, HM_REG_LARGEST_CHANGE, HM_REG_CYCLES_LO})
      words.push_back(dut.read(r));
    words.push_back(static_cast<std::uint32_t>(dut.device.cells.sequencer.total_cycles()));
    return words;
  }

  Dut dut;
  std::vector<std::int64_t> seen;
  std::vector<Entry> diary;
};

using All = std::vector<std::unique_ptr<Watched>>;

/// To the next instant at which anything happens, and through all of it.
bool next_event() {
  if (!sc_core::sc_pending_activity()) return false;
  sc_core::sc_start(sc_core::sc_time_to_pending_activity());
  while (sc_core::sc_pending_activity_at_current_time()) sc_core::sc_start(sc_core::SC_ZERO_TIME);
  return true;
}

void run_watched(const All& all, const ArrayJob& job, int runs) {
  for (int run = 0; run < runs; ++run) {
    for (const auto& w : all) {
      w->look(); // everybody at the same time, before anything moves
      w->dut.write(HM_REG_IRQ_STATUS, ~0u);
      w->dut.write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
      w->dut.start(job.threshold, job.max_sweeps);
    }
    while (next_event())
      for (const auto& w : all) w->look();
  }
}

/// By phase, by clock, and three devices that walk windows of their own.
All make_all(Dice& dice, const ArrayJob& job, std::uint64_t cycles) {
  All all;
  const auto add = [&](const char* name, CycleWindow window) {
    all.push_back(std::make_unique<Watched>(name, job));
    all.back()->dut.device.walk(window);
  };
  add("by_phase", {});
  add("by_clock", {0, UINT64_MAX});
  for (const char* name : {"window_0", "window_1", "window_2"}) {
    const std::uint64_t first = dice.below(cycles);
    add(name, {first, first + 1 + dice.below(cycles - first)});
  }
  return all;
}

void expect_same_diary(const Watched& w, const Watched& by_phase) {
  ASSERT_EQ(w.diary.size(), by_phase.diary.size()) << w.dut.name();
  for (std::size_t k = 0; k < w.diary.size(); ++k)
    ASSERT_EQ(w.diary[k], by_phase.diary[k])
        << w.dut.name() << ": V" << w.diary[k].what << " at " << w.diary[k].picoseconds << " ps, by phase V"
        << by_phase.diary[k].what << " at " << by_phase.diary[k].picoseconds << " ps";
}

/// Neurons of a folded array that is woken by phase show V at the phase's end, by clock when each writes it:
/// so each has the values in their order, and no one later than by phase.
void expect_same_values(const Watched& w, const Watched& by_phase) {
  const std::size_t line = w.dut.device.cells.topology().neurons();
  for (std::size_t what = 0; what <= line; ++what) {
    std::vector<Watched::Entry> own, other;
    for (const auto& e : w.diary)
      if (e.what == what) own.push_back(e);
    for (const auto& e : by_phase.diary)
      if (e.what == what) other.push_back(e);
    ASSERT_EQ(own.size(), other.size()) << w.dut.name() << ": V" << what;
    for (std::size_t k = 0; k < own.size(); ++k) {
      ASSERT_EQ(own[k].value, other[k].value) << w.dut.name() << ": V" << what;
      ASSERT_LE(own[k].picoseconds, other[k].picoseconds) << w.dut.name() << ": V" << what;
      ASSERT_TRUE(what < line || own[k] == other[k]) << "the interrupt line";
    }
  }
}

void expect_alike(const All& all) {
  const bool folded = spec::is_folded(all[0]->dut.device.cells.array());
  for (const auto& w : all) {
    EXPECT_EQ(w->counters(), all[0]->counters());
    if (folded)
      expect_same_values(*w, *all[0]);
    else
      expect_same_diary(*w, *all[0]);
  }
}

class Waking : public testing::TestWithParam<int> {};

TEST_P(Waking, IsNoMatterForBitsOrTimes) {
  const std::uint64_t seed = 7000 + static_cast<std::uint64_t>(GetParam());
  Dice dice(seed);
  ArrayJob job = random_job(seed, 12);
  job.array.schedule = static_cast<spec::Schedule>(GetParam() % 3);
  job.max_sweeps = 1 + static_cast<std::uint32_t>(dice.below(5));
  job.array.clock_mhz = dice.one_in(2) ? 100 : 0.5 + 600 * dice.unit(); // periods of odd picoseconds too
  SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job) + ", " +
               std::to_string(job.array.clock_mhz) + " MHz");
  const int runs = 2;
  const All all = make_all(dice, job, runs * slow_cycles(job, job.max_sweeps));
  for (const auto& w : all) load(w->dut, job);
  run_watched(all, job, runs);
  EXPECT_GE(all[0]->diary.size(), 3u); // the line rises, falls, rises
  expect_alike(all);
}

INSTANTIATE_TEST_SUITE_P(Random, Waking, testing::Range(0, 60));

/// Every window of a short run: those that begin or end within a segment, at its ends, of one cycle.
class WalkWindows : public testing::TestWithParam<int> {};

/// Of so many elements: none, one, some.
TEST_P(WalkWindows, EveryOneOfAShortRun) {
  spec::ArraySpec array = spec::byte_array();
  array.elements = GetParam();
  array.stages = static_cast<spec::Stages>(GetParam() == 1);
  array.lanes = 4;
  array.clock_mhz = 3; // 333333 ps
  ArrayJob job = lively_job(41, array, topology_of(2, 2, {{0, 1}}));
  job.max_sweeps = 1;
  const std::uint64_t cycles = slow_cycles(job, 1);
  ASSERT_GT(cycles, 20u);
  All all;
  all.push_back(std::make_unique<Watched>("by_phase", job));
  for (std::uint64_t first = 0; first < cycles; ++first)
    for (std::uint64_t last = first; last <= cycles; ++last) {
      const std::string name = "window_" + std::to_string(first) + "_" + std::to_string(last);
      all.push_back(std::make_unique<Watched>(name, job));
      all.back()->dut.device.walk({first, last});
    }
  for (const auto& w : all) load(w->dut, job);
  run_watched(all, job, 1);
  expect_alike(all);
}

INSTANTIATE_TEST_SUITE_P(Elements, WalkWindows, testing::Values(0, 1, 2));

/// The host changes its mind while the array runs.
TEST(WalkWindow, ChangedInTheMiddleOfARun) {
  ArrayJob job = lively_job(42, small_array(), grid_topology(2, 2, true));
  job.max_sweeps = 4;
  All all;
  all.push_back(std::make_unique<Watched>("by_phase", job));
  all.push_back(std::make_unique<Watched>("fickle", job));
  for (const auto& w : all) load(w->dut, job);
  for (const auto& w : all) w->look();
  for (const auto& w : all) w->dut.start(0, job.max_sweeps);
  Dice dice(43);
  std::uint64_t switches = 0;
  while (next_event()) {
    for (const auto& w : all) w->look();
    if (!dice.one_in(5)) continue;
    all[1]->dut.device.wake(++switches % 2 ? systemc::Waking::by_clock : systemc::Waking::by_phase);
  }
  EXPECT_GT(switches, 10u);
  expect_alike(all);
}

} // namespace
} // namespace hopmesh::tests
