// The sequencer alone: its segments in their order, each beat once, and the events at the ends of segments.
#include "rtl_model/systemc/sequencer.h"
#include "tests/support/dut.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Segment;
using systemc::Sequencer;
using Beat = std::pair<int, std::uint64_t>; ///< segment and beat

/// Notes what neurons would see at each edge, and when the events of segments come.
class Listener : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Listener);
  Listener(sc_core::sc_module_name name, const Sequencer& s, std::size_t phases)
      : sc_module(name), sequencer(s) {
    SC_METHOD(on_clock);
    sensitive << s.clock().posedge_event();
    dont_initialize();
    SC_METHOD(on_prepare);
    sensitive << s.prepare_done();
    dont_initialize();
    SC_METHOD(on_phase);
    for (std::size_t k = 0; k < phases; ++k) sensitive << s.phase_done(k);
    dont_initialize();
    SC_METHOD(on_done);
    sensitive << s.run_done();
    dont_initialize();
  }

  const Sequencer& sequencer;
  std::vector<Beat> beats;
  std::vector<std::uint64_t> prepared, phased, done; ///< cycles since time 0

 private:
  static std::uint64_t now() { return sc_core::sc_time_stamp().value() / 10000; }
  void on_clock() { beats.push_back({sequencer.segment(), sequencer.beat()}); }
  void on_prepare() { prepared.push_back(now()); }
  void on_phase() { phased.push_back(now()); }
  void on_done() { done.push_back(now()); }
};

struct Bench {
  Bench(const std::string& name, const spec::CycleModel& c)
      : cycles(c), detector(("detector_" + name).c_str()), momentum(("momentum_" + name).c_str(), 0),
        sequencer(("sequencer_" + name).c_str(), cycles, sc_core::sc_time(10.0, sc_core::SC_NS), detector,
                  momentum),
        listener(("listener_" + name).c_str(), sequencer, cycles.phase.size()) {}
  const spec::CycleModel cycles;
  systemc::ConvergenceDetector detector;
  systemc::MomentumTable momentum;
  Sequencer sequencer;
  Listener listener;
};

spec::CycleModel model(std::uint64_t prepare, const std::vector<std::uint64_t>& phases) {
  spec::CycleModel m;
  m.prepare = prepare;
  m.phase = phases;
  m.sweep = 1;
  for (std::uint64_t p : phases) m.sweep += p;
  return m;
}

void run(Bench& b, std::uint64_t sweeps) {
  b.sequencer.begin_run(0, sweeps, {}, sc_core::SC_ZERO_TIME);
  sc_core::sc_start(sc_core::sc_time(10.0, sc_core::SC_NS) * static_cast<double>(b.cycles.run(sweeps) + 2));
}

TEST(SequencerAlone, ShowsEveryBeatOfEverySegmentOnce) {
  Bench b("b", model(3, {4, 1, 2}));
  b.sequencer.walk({0, UINT64_MAX});
  Dut::elaborate();
  run(b, 1);
  const int phase = Segment::first_phase;
  const std::vector<Beat> expected{{Segment::start, 0},
                                   {Segment::prepare, 0},
                                   {Segment::prepare, 1},
                                   {Segment::prepare, 2},
                                   {phase, 0},
                                   {phase, 1},
                                   {phase, 2},
                                   {phase, 3},
                                   {phase + 1, 0},
                                   {phase + 2, 0},
                                   {phase + 2, 1},
                                   {Segment::check, 0}};
  EXPECT_EQ(b.listener.beats, expected);
  EXPECT_EQ(b.listener.done, (std::vector<std::uint64_t>{12}));
  EXPECT_TRUE(b.listener.prepared.empty());
  EXPECT_TRUE(b.listener.phased.empty());
  EXPECT_EQ(b.sequencer.segment(), Segment::idle);
}

TEST(SequencerAlone, WithoutPrepareGoesStraightToThePhases) {
  Bench b("b", model(0, {2}));
  b.sequencer.walk({0, UINT64_MAX});
  Dut::elaborate();
  run(b, 1);
  const int phase = Segment::first_phase;
  EXPECT_EQ(b.listener.beats,
            (std::vector<Beat>{{Segment::start, 0}, {phase, 0}, {phase, 1}, {Segment::check, 0}}));
}

TEST(SequencerAlone, ByPhaseSpeaksAtTheEndOfEachSegmentOnly) {
  Bench b("b", model(3, {4, 1, 2}));
  Dut::elaborate();
  run(b, 1);
  EXPECT_TRUE(b.listener.beats.empty());
  EXPECT_EQ(b.listener.prepared, (std::vector<std::uint64_t>{4}));
  EXPECT_EQ(b.listener.phased, (std::vector<std::uint64_t>{8, 9, 11}));
  EXPECT_EQ(b.listener.done, (std::vector<std::uint64_t>{12}));
  EXPECT_EQ(b.sequencer.run_cycles(), 12u);
}

/// Cycles are counted over all runs: the window lies in the second one, inside a phase, and the whole segment
/// that it touches is walked.
TEST(SequencerAlone, AWindowWalksTheSegmentsItTouches) {
  Bench b("b", model(3, {4, 1, 2}));
  b.sequencer.walk({12 + 6, 12 + 8});
  Dut::elaborate();
  run(b, 1);
  EXPECT_TRUE(b.listener.beats.empty());
  run(b, 1);
  const int phase = Segment::first_phase;
  EXPECT_EQ(b.listener.beats, (std::vector<Beat>{{phase, 0}, {phase, 1}, {phase, 2}, {phase, 3}}));
  EXPECT_EQ(b.sequencer.total_cycles(), 24u);
  EXPECT_EQ(b.sequencer.run_cycles(), 12u);
}

TEST(SequencerAlone, AWindowEndsWhereTheNextSegmentBegins) {
  Bench b("b", model(3, {4, 1, 2}));
  b.sequencer.walk({1, 4}); // prepare, exactly
  Dut::elaborate();
  run(b, 1);
  EXPECT_EQ(b.listener.beats,
            (std::vector<Beat>{{Segment::prepare, 0}, {Segment::prepare, 1}, {Segment::prepare, 2}}));
}

TEST(SequencerAlone, AnEmptyWindowWalksNothing) {
  Bench b("b", model(3, {4, 1, 2}));
  b.sequencer.walk({5, 5});
  Dut::elaborate();
  run(b, 1);
  EXPECT_TRUE(b.listener.beats.empty());
}

} // namespace
} // namespace hopmesh::tests
