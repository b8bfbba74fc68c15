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
    : array_(array), period_(period), file_(request.file, unit_of(period)), of_phase_(array.phases().size()),
      sum_width_(array.formats().accumulator.width), drive_width_(array.formats().drive.width),
      state_width_(array.formats().state.width) {
  for (const char* scope : {"SystemC", "array_0", "device"}) file_.open_scope(scope);
  irq_ = file_.add("irq", 1);
  file_.open_scope("cells");
  if (request.cells.empty())
    for (std::size_t c = 0; c < array.topology().cells(); ++c) add_cell(c);
  for (std::size_t c : request.cells) add_cell(c);
  add_sequencer();
  for (int k = 0; k < 4; ++k) file_.close_scope();
  const auto phase = spec::phase_of_neurons(array.topology(), array.phases());
  for (const Watched& w : watched_) of_phase_[phase[w.neuron]].push_back(w);
  file_.set(irq_, irq_now);
}

void ClockedVcd::add_cell(std::size_t cell) {
  const auto per_cell = static_cast<std::size_t>(array_.topology().neurons_per_cell);
  file_.open_scope("cell_" + std::to_string(cell));
  for (std::size_t p = 0; p < per_cell; ++p) {
    file_.open_scope("neuron_" + std::to_string(p));
    file_.open_scope("accumulator");
    watched_.push_back({cell * per_cell + p, file_.add("s", sum_width_)});
    file_.add("norm", 64);
    file_.close_scope();
    file_.open_scope("output");
    file_.add("u", drive_width_);
    file_.add("delta", state_width_ + 1);
    file_.add("V", state_width_);
    file_.close_scope();
    file_.close_scope();
  }
  file_.close_scope();
}

void ClockedVcd::add_sequencer() {
  file_.open_scope("sequencer");
  clock_ = file_.add("clock", 1);
  segment_ = file_.add("segment", 32);
  beat_ = file_.add("beat", 64);
  busy_ = file_.add("busy", 1);
  sweeps_ = file_.add("sweeps", 64);
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
  if (segment == engine::ClockedEngine::prepare)
    for (const Watched& w : watched_) show_norm(w);
  if (segment >= engine::ClockedEngine::first_phase)
    for (const Watched& w : of_phase_[static_cast<std::size_t>(segment - engine::ClockedEngine::first_phase)])
      show_phase(w);
  show_sequencer(asleep);
}

void ClockedVcd::show_sequencer(bool asleep) {
  file_.set(segment_, asleep ? engine::ClockedEngine::idle : array_.segment());
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
