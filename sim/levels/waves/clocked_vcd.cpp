#include "sim/levels/waves/clocked_vcd.h"

namespace hopmesh::levels {

namespace {

// Half a cycle is so many nanoseconds, or not.
std::uint64_t unit_of(std::uint64_t period) {
  return period % 2000 == 0 ? 1000 : 1;
}

} // namespace

ClockedVcd::ClockedVcd(const WaveRequest& request, const engine::ClockedEngine& array, std::uint64_t period,
                       bool irq_now)
    : array_(array), period_(period), file_(request.file, unit_of(period)), of_phase_(array.phases().size()) {
  for (const char* scope : {"SystemC", "array_0", "device"}) file_.open_scope(scope);
  irq_ = add(spec::irq_signal);
  file_.open_scope(spec::cells_scope);
  if (request.cells.empty())
    for (std::size_t c = 0; c < array.topology().cells(); ++c) add_cell(c);
  for (std::size_t c : request.cells) add_cell(c);
  add_sequencer();
  for (int k = 0; k < 4; ++k) file_.close_scope();
  const auto phase = spec::phase_of_neurons(array.topology(), array.phases());
  for (const Watched& w : watched_) of_phase_[phase[w.neuron]].push_back(w);
  file_.set(irq_, irq_now);
}

std::size_t ClockedVcd::add(const spec::Signal& signal) {
  return file_.add(signal.name, signal.width);
}

void ClockedVcd::add_cell(std::size_t cell) {
  const auto per_cell = static_cast<std::size_t>(array_.topology().neurons_per_cell);
  file_.open_scope(spec::cell_scope(cell));
  for (std::size_t p = 0; p < per_cell; ++p) add_neuron(cell * per_cell + p, spec::neuron_scope(p));
  file_.close_scope();
}

void ClockedVcd::add_neuron(std::size_t neuron, const std::string& scope) {
  const spec::NeuronSignals signals = spec::neuron_signals(array_.formats());
  file_.open_scope(scope);
  file_.open_scope(spec::accumulator_scope);
  watched_.push_back({neuron, add(signals.sum)});
  add(signals.norm);
  file_.close_scope();
  file_.open_scope(spec::output_scope);
  add(signals.drive);
  add(signals.change);
  add(signals.state);
  file_.close_scope();
  file_.close_scope();
}

void ClockedVcd::add_sequencer() {
  namespace signals = spec::sequencer_signals;
  file_.open_scope(signals::scope);
  clock_ = add(signals::clock);
  segment_ = add(signals::segment);
  beat_ = add(signals::beat);
  busy_ = add(signals::busy);
  sweeps_ = add(signals::sweeps);
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
  for (const Watched& w : watched_) {
    show_norm(w);
    show_phase(w);
  }
  file_.set(busy_, array_.busy());
  file_.set(sweeps_, array_.result().sweeps);
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
  if (segment == spec::Segment::prepare)
    for (const Watched& w : watched_) show_norm(w);
  if (segment >= spec::Segment::first_phase)
    for (const Watched& w : of_phase_[static_cast<std::size_t>(segment - spec::Segment::first_phase)])
      show_phase(w);
  show_sequencer(asleep);
}

void ClockedVcd::show_sequencer(bool asleep) {
  file_.set(segment_, asleep ? +spec::Segment::idle : array_.segment());
  file_.set(beat_, static_cast<std::int64_t>(array_.beat()));
  file_.set(busy_, array_.busy());
  file_.set(sweeps_, array_.result().sweeps);
}

void ClockedVcd::show_norm(const Watched& w) {
  file_.set(w.signal + 1, array_.norm(w.neuron));
}

void ClockedVcd::show_phase(const Watched& w) {
  file_.set(w.signal, array_.sum(w.neuron));
  file_.set(w.signal + 2, array_.drive(w.neuron));
  file_.set(w.signal + 3, array_.change(w.neuron));
  file_.set(w.signal + 4, array_.state(w.neuron));
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
