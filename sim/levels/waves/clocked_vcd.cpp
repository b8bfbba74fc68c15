#include "sim/levels/waves/clocked_vcd.h"

namespace hopmesh::levels {

namespace {

// Half a cycle is so many nanoseconds, or not.
std::uint64_t unit_of(std::uint64_t period) {
  return period % 2000 == 0 ? 1000 : 1;
}

std::vector<std::size_t> cells_of(const WaveRequest& request, const spec::Topology& topology) {
  std::vector<std::size_t> cells = request.cells;
  for (std::size_t c = 0; request.cells.empty() && c < topology.cells(); ++c) cells.push_back(c);
  return cells;
}

} // namespace

ClockedVcd::ClockedVcd(const WaveRequest& request, const engine::ClockStepped& array, std::uint64_t period,
                       bool irq_now)
    : array_(array), period_(period), file_(request.file, unit_of(period)),
      probes_(array.probes(cells_of(request, array.topology()))), of_phase_(array.phases().size()) {
  for (const char* scope : {"SystemC", "array_0", "device"}) file_.open_scope(scope);
  irq_ = add(spec::irq_signal);
  file_.open_scope(spec::cells_scope);
  add_probes();
  add_sequencer();
  for (int k = 0; k < 4; ++k) file_.close_scope();
  file_.set(irq_, irq_now);
}

std::size_t ClockedVcd::add(const spec::Signal& signal) {
  return file_.add(signal.name, signal.width);
}

// From one probe to the next, scopes that they do not share are closed and opened.
void ClockedVcd::add_probes() {
  std::vector<std::string> open;
  const auto close_to = [&](std::size_t depth) {
    for (; open.size() > depth; open.pop_back()) file_.close_scope();
  };
  for (const engine::Probe& probe : probes_) {
    const auto end = open.begin() + static_cast<std::ptrdiff_t>(std::min(open.size(), probe.scopes.size()));
    close_to(static_cast<std::size_t>(std::mismatch(open.begin(), end, probe.scopes.begin()).first -
                                      open.begin()));
    for (std::size_t k = open.size(); k < probe.scopes.size(); ++k) {
      file_.open_scope(probe.scopes[k]);
      open.push_back(probe.scopes[k]);
    }
    std::vector<Watched>& list = probe.changes == engine::Probe::in_all ? always_
                                 : probe.changes == engine::Probe::in_prepare
                                     ? of_prepare_
                                     : of_phase_[static_cast<std::size_t>(probe.changes)];
    list.push_back({&probe, add(probe.signal)});
  }
  close_to(0);
}

void ClockedVcd::add_sequencer() {
  namespace signals = spec::sequencer_signals;
  file_.open_scope(signals::scope);
  clock_ = add(signals::clock);
  segment_ = add(signals::segment);
  beat_ = add(signals::beat);
  busy_ = add(signals::busy);
  sweeps_ = add(signals::sweeps);
  if (array_.has_momentum()) momentum_ = add(signals::momentum);
  file_.close_scope();
}

// A clock that is high falls half a cycle after its edge, whatever comes next.
void ClockedVcd::pass(std::uint64_t halves) {
  if (!high_ || falls_ > halves) return;
  high_ = false;
  file_.time(falls_ * (period_ / 2) + falls_ / 2 * (period_ % 2));
  file_.set(clock_, 0);
}

// Half a cycle of an odd period is rounded down: what happens in its middle comes a picosecond after the
// fall.
void ClockedVcd::at(std::uint64_t halves) {
  pass(halves);
  time_ = std::max(time_, (halves * period_ + 1) / 2);
  file_.time(time_);
}

void ClockedVcd::show_host(std::uint64_t halves) {
  at(halves);
  show(always_);
  show(of_prepare_);
  for (const auto& watched : of_phase_) show(watched);
  show_counters();
  if (!file_.begun()) file_.begin(time_);
}

void ClockedVcd::show_all(std::uint64_t halves) {
  show_sequencer(false);
  show_host(halves);
}

void ClockedVcd::show_start(std::uint64_t halves) {
  at(halves);
  show_sequencer(false);
}

void ClockedVcd::edge(std::uint64_t halves, int segment, bool asleep) {
  at(halves);
  file_.set(clock_, 1);
  high_ = true;
  falls_ = halves + 1;
  show(always_);
  if (segment == spec::Segment::prepare) show(of_prepare_);
  if (segment >= spec::Segment::first_phase)
    show(of_phase_[static_cast<std::size_t>(segment - spec::Segment::first_phase)]);
  show_sequencer(asleep);
}

void ClockedVcd::show_sequencer(bool asleep) {
  file_.set(segment_, asleep ? +spec::Segment::idle : array_.segment());
  file_.set(beat_, static_cast<std::int64_t>(array_.beat()));
  show_counters();
}

void ClockedVcd::show_counters() {
  file_.set(busy_, array_.busy());
  file_.set(sweeps_, array_.result().sweeps);
  if (array_.has_momentum()) file_.set(momentum_, array_.entry());
}

void ClockedVcd::show(const std::vector<Watched>& watched) {
  for (const Watched& w : watched) file_.set(w.signal, w.probe->code());
}

void ClockedVcd::irq(std::uint64_t halves, bool level) {
  at(halves);
  file_.set(irq_, level);
}

// A fall in this very instant is not a part of the window.
void ClockedVcd::finish(std::uint64_t halves) {
  if (falls_ * (period_ / 2) + falls_ / 2 * (period_ % 2) < (halves * period_ + 1) / 2) pass(halves);
  high_ = false;
  at(halves);
  file_.finish();
}

} // namespace hopmesh::levels
