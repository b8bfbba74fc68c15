#include "sim/engine/clocked/clock_stepped.h"

#include "sim/engine/clocked/clocked.h"
#include "sim/engine/clocked/clocked_fold.h"
#include "sim/engine/overflow.h"

namespace hopmesh::engine {

using spec::Segment;

ClockStepped::ClockStepped(const spec::ArraySpec& array, const spec::Topology& topology)
    : topology_(topology), phases_(spec::phases_of(topology, array.schedule)),
      cycles_(spec::cycle_model(array, topology, phases_)), plan_(array, topology),
      rule_(spec::has_momentum(array) ? static_cast<std::size_t>(array.momentum_entries) : 0) {}

void ClockStepped::write_momentum(std::size_t first, const std::uint32_t* words, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    rule_.table()[first + k] = kept_bits(words[k], spec::momentum_format);
}

void ClockStepped::start(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule) {
  rule_.begin(threshold, rule);
  max_sweeps_ = std::max(max_sweeps, 1u);
  result_ = {};
  done_ = false;
  enter(Segment::start);
}

void ClockStepped::step(std::uint64_t clocks) {
  while (clocks > 0 && segment_ != Segment::idle) {
    const std::uint64_t left = length_ - beat_, some = std::min(clocks, left);
    if (segment_ >= Segment::first_phase || segment_ == Segment::prepare) do_beats(beat_, beat_ + some);
    clocks -= some;
    result_.cycles += some;
    beat_ += some;
    if (some == left) leave_segment();
  }
}

void ClockStepped::enter(int segment) {
  segment_ = segment;
  beat_ = 0;
  length_ = spec::segment_cycles(cycles_, segment);
  if (segment_ == Segment::first_phase) detected_ = {};
  entered();
}

void ClockStepped::leave_segment() {
  if (segment_ == Segment::start && has_momentum()) restart();
  if (segment_ == Segment::check) {
    result_.sweeps += 1;
    result_.largest_change = static_cast<std::uint32_t>(detected_.largest_change);
    result_.largest_sum = static_cast<std::uint64_t>(detected_.largest_sum);
    result_.converged = rule_.over(detected_);
    if (rule_.restarts(detected_)) restart();
    rule_.pass(detected_);
  }
  if (segment_ == Segment::start || segment_ == Segment::check)
    entry_ = static_cast<std::int64_t>(rule_.entry());
  enter(spec::next_segment(cycles_, segment_, result_.converged || result_.sweeps == max_sweeps_));
  done_ = segment_ == Segment::idle;
}

std::unique_ptr<ClockStepped> make_clock_stepped(const spec::ArraySpec& array,
                                                 const spec::Topology& topology) {
  if (spec::is_folded(array)) return std::make_unique<ClockedFold>(array, topology);
  return std::make_unique<ClockedEngine>(array, topology);
}

} // namespace hopmesh::engine
