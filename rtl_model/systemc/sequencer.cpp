#include "rtl_model/systemc/sequencer.h"

#include "rtl_model/systemc/trace.h"

namespace hopmesh::systemc {

using sc_core::sc_time;
using spec::Segment;

Sequencer::Sequencer(sc_core::sc_module_name name, const spec::CycleModel& cycles, sc_time period,
                     ConvergenceDetector& detector, MomentumTable& momentum)
    : sc_module(name), cycles_(cycles), period_(period), detector_(detector), momentum_(momentum),
      phase_done_(cycles.phase.size()), clock_("clock", false), segment_("segment", Segment::idle),
      running_("running", Segment::idle), beat_("beat", 0) {
  SC_METHOD(on_segment_end);
  sensitive << segment_end_;
  dont_initialize();
  SC_METHOD(on_clock);
  sensitive << clock_.posedge_event();
  dont_initialize();
  SC_METHOD(toggle_clock);
  sensitive << clock_edge_;
  dont_initialize();
}

void Sequencer::begin_run(std::uint64_t threshold, std::uint64_t max_sweeps, const spec::StopRule& rule,
                          sc_time delay) {
  threshold_ = threshold;
  rule_ = rule;
  detector_.begin_run(rule.by_sum);
  max_sweeps_ = std::max<std::uint64_t>(max_sweeps, 1);
  busy_ = true;
  converged_ = aborted_ = false;
  sweeps_ = run_cycles_ = 0;
  at_ = Segment::idle;
  segment_end_.notify(until_edge(delay));
}

sc_time Sequencer::until_edge(sc_time delay) const {
  const sc_time late = (sc_core::sc_time_stamp() + delay) % period_;
  return late == sc_core::SC_ZERO_TIME ? delay : delay + period_ - late;
}

// Of the run: does it end with the check at hand?
bool Sequencer::over() const {
  return converged_ || aborted_ || sweeps_ == max_sweeps_;
}

bool Sequencer::walks(std::uint64_t cycles) const {
  return walked_.first < walked_.last && total_cycles_ < walked_.last &&
         total_cycles_ + cycles > walked_.first;
}

// What a segment leaves behind in its last cycle.
void Sequencer::leave_segment() {
  const std::uint64_t length = spec::segment_cycles(cycles_, at_);
  total_cycles_ += length;
  run_cycles_ += length;
  if (at_ == Segment::check) leave_check();
  if (at_ != Segment::start || !momentum_.exists()) return;
  momentum_.begin_run();
  settled_.notify(sc_core::SC_ZERO_TIME);
}

void Sequencer::leave_check() {
  sweeps_ += 1;
  if (sweeps_ == 1) first_sum_ = static_cast<std::uint64_t>(detector_.largest_sum());
  converged_ = at_rest();
  if (!momentum_.exists()) return;
  const bool restart = detector_.way() < 0;
  momentum_.end_sweep(restart);
  if (restart) settled_.notify(sc_core::SC_ZERO_TIME);
}

bool Sequencer::at_rest() const {
  if (!rule_.by_sum) return static_cast<std::uint64_t>(detector_.largest_change()) <= threshold_;
  const std::uint64_t share = rule_.share > 0 ? first_sum_ >> rule_.share : 0;
  return static_cast<std::uint64_t>(detector_.largest_sum()) <= std::max(rule_.floor, share);
}

void Sequencer::enter(int segment) {
  running_ = at_ = segment;
  if (at_ == Segment::idle) return finish();
  if (at_ == Segment::first_phase) detector_.begin_sweep();
  const std::uint64_t length = spec::segment_cycles(cycles_, at_);
  const bool was_clocked = clocked_;
  clocked_ = walks(length);
  segment_ = clocked_ ? at_ : static_cast<int>(Segment::idle);
  beat_ = 0;
  beats_left_ = length;
  if (clocked_) {
    if (!was_clocked) clock_edge_.notify(period_);
    return;
  }
  const sc_time end = period_ * static_cast<double>(length);
  if (at_ == Segment::prepare) prepare_done_.notify(end);
  if (at_ >= Segment::first_phase) phase_done_[at_ - Segment::first_phase].notify(end);
  segment_end_.notify(end);
}

void Sequencer::on_segment_end() {
  leave_segment();
  enter(spec::next_segment(cycles_, at_, over()));
}

// An edge ends a cycle: neurons do the work of the beat shown so far, the next beat shows from now on.
void Sequencer::on_clock() {
  if (!clocked_) return;
  beats_left_ -= 1;
  if (beats_left_ > 0)
    beat_ = beat_.read() + 1;
  else
    on_segment_end();
}

// Rising at the end of every cycle, falling half-way; rests low when nobody walks clock by clock.
void Sequencer::toggle_clock() {
  const sc_time high = sc_time::from_value(period_.value() / 2); // a period of odd length is not halved twice
  if (clock_.read()) {
    clock_ = false;
    if (clocked_) clock_edge_.notify(period_ - high);
  } else {
    clock_ = true;
    clock_edge_.notify(high);
  }
}

void Sequencer::finish() {
  busy_ = clocked_ = false;
  segment_ = Segment::idle;
  beat_ = 0;
  run_done_.notify(sc_core::SC_ZERO_TIME);
}

void Sequencer::trace(sc_core::sc_trace_file* file) const {
  namespace signals = spec::sequencer_signals;
  sc_core::sc_trace(file, clock_, traced_name(*this, signals::clock));
  sc_core::sc_trace(file, segment_, traced_name(*this, signals::segment));
  sc_core::sc_trace(file, beat_, traced_name(*this, signals::beat));
  sc_core::sc_trace(file, busy_, traced_name(*this, signals::busy));
  sc_core::sc_trace(file, sweeps_, traced_name(*this, signals::sweeps));
  momentum_.trace_entry(file, *this);
}

} // namespace hopmesh::systemc
