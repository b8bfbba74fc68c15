// Walks a run through its segments: take START, prepare, phase after phase, convergence check, sweep after
// sweep, DONE.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/relaxation.h"
#include "rtl_model/systemc/convergence_detector.h"

#include <systemc>

namespace hopmesh::systemc {

/// How neuron processes wake: at the end of their phase, accounting for its cycles; or at every clock, as in
/// waves. Phases and clocks give the same bits at the same times; but neurons of a folded array, of which
/// each has a time of its own inside a phase, all show V at its end when woken by phase.
enum class Waking { by_phase, by_clock };

/// Cycles of all runs so far, counted on: [first, last) is walked clock by clock.
struct CycleWindow {
  std::uint64_t first = 0, last = 0;
};

/// Owns time. By phase, it notifies `prepare_done()` and `phase_done(k)` in the last cycle of that segment
/// and sleeps in between. By clock, it runs `clock()` and shows `segment()` and `beat()` of the current
/// cycle, one cycle an edge.
class Sequencer : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Sequencer);
  Sequencer(sc_core::sc_module_name name, const spec::CycleModel& cycles, sc_core::sc_time period,
            ConvergenceDetector& detector, MomentumTable& momentum);

  const sc_core::sc_event& prepare_done() const { return prepare_done_; }
  const sc_core::sc_event& phase_done(std::size_t k) const { return phase_done_[k]; }
  const sc_core::sc_event& run_done() const { return run_done_; }
  /// Of a momentum array: Y begins at V again, for a run or after a sweep that went the wrong way.
  const sc_core::sc_event& settled() const { return settled_; }
  const sc_core::sc_signal<bool>& clock() const { return clock_; }
  std::uint64_t phase_cycles(std::size_t k) const { return cycles_.phase[k]; }
  std::uint64_t prepare_cycles() const { return cycles_.prepare; }
  int segment() const { return segment_.read(); } ///< a number of spec::Segment; idle while nobody walks
  /// The segment that runs, walked or not. To who is woken by its end it is still that one.
  int running() const { return running_.read(); }
  std::uint64_t beat() const { return beat_.read(); }

  /// Begins a run on the first clock edge not before now + delay. Only when idle.
  void begin_run(std::uint64_t threshold, std::uint64_t max_sweeps, const spec::StopRule& rule,
                 sc_core::sc_time delay);
  bool busy() const { return busy_; }
  /// Lets the run at hand end with its next check.
  void abort() { aborted_ = true; }
  bool aborted() const { return aborted_; } ///< the last run, or the one at hand
  /// A delay from now on, lengthened to the next clock edge.
  sc_core::sc_time until_edge(sc_core::sc_time delay) const;

  /// Which cycles to walk clock by clock; takes effect at the next segment.
  void walk(CycleWindow window) { walked_ = window; }

  std::uint64_t sweeps() const { return sweeps_; }
  bool converged() const { return converged_; }
  std::uint64_t run_cycles() const { return run_cycles_; } ///< of the last run
  std::uint64_t total_cycles() const {
    return total_cycles_;
  } ///< of all runs, up to the current segment's start

  void trace(sc_core::sc_trace_file* file) const override;

 private:
  void on_segment_end();
  void on_clock();
  void toggle_clock();
  void enter(int segment);
  void leave_segment();
  void leave_check();
  bool at_rest() const;
  void finish();
  bool over() const;
  bool walks(std::uint64_t cycles) const;

  const spec::CycleModel cycles_;
  const sc_core::sc_time period_;
  ConvergenceDetector& detector_;
  MomentumTable& momentum_;
  std::vector<sc_core::sc_event> phase_done_;
  sc_core::sc_event prepare_done_, run_done_, settled_, segment_end_, clock_edge_;
  sc_core::sc_signal<bool> clock_;
  sc_core::sc_signal<int, sc_core::SC_MANY_WRITERS> segment_; // by one process or the other, never both
  sc_core::sc_signal<int, sc_core::SC_MANY_WRITERS> running_;
  sc_core::sc_signal<std::uint64_t, sc_core::SC_MANY_WRITERS> beat_;
  CycleWindow walked_;
  int at_ =
      spec::Segment::idle; ///< the segment that runs now; segment_ shows it while clocks run, running_ always
  std::uint64_t beats_left_ = 0;
  bool busy_ = false, converged_ = false, aborted_ = false, clocked_ = false;
  spec::StopRule rule_;
  std::uint64_t first_sum_ = 0; ///< the largest |s| of the run's first sweep
  std::uint64_t threshold_ = 0, max_sweeps_ = 1, sweeps_ = 0, run_cycles_ = 0, total_cycles_ = 0;
};

} // namespace hopmesh::systemc
