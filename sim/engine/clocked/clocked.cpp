#include "sim/engine/clocked/clocked.h"

#include "sim/engine/overflow.h"
#include "sim/engine/row_walk.h"

namespace hopmesh::engine {

using spec::Segment;

ClockedEngine::ClockedEngine(const spec::ArraySpec& array, const spec::Topology& topology)
    : ClockStepped(array, topology), layout_(array, topology, phases_),
      drive_cycles_(spec::drive_cycles(array)), change_cycles_(spec::change_cycles(array)),
      beats_(plan_, layout_), row_(topology.neurons()) {
  const auto per_cell = static_cast<std::size_t>(topology.neurons_per_cell);
  for (std::size_t k = 0; k < row_.size(); ++k)
    row_[k] = static_cast<std::uint32_t>(layout_.row(k / per_cell, k % per_cell));
}

void ClockedEngine::write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) {
  walk_rows(
      topology_, first, count, [&](std::size_t cell, std::size_t p, std::size_t tap, std::size_t piece) {
        for (std::size_t k = 0; k < piece; ++k)
          beats_.at.weight[layout_.weight(cell, p, tap + k)] = kept_bits(*words++, plan_.formats.weight);
      });
}

void ClockedEngine::write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    beats_.at.bias[row_[first + k]] = kept_bits(words[k], plan_.formats.bias);
}

void ClockedEngine::write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) {
  const auto one = static_cast<std::int32_t>(plan_.one_state);
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  for (std::size_t k = first; k < first + count; ++k) {
    const std::int32_t code = std::min(std::max(kept_bits(*words++, plan_.formats.state), -one), one);
    beats_.load(k / per_cell, k % per_cell, code);
  }
}

// Most clocks lie inside a phase and add one tap: they take this short way.
void ClockedEngine::step() {
  if (plain_.beat == nullptr || beat_ == 0 || beat_ + 1 >= length_) return step(1);
  const ClockedBeat& b = plain_.beat[beat_];
  if (b.rows > 0)
    plain_.add(plain_.weights + beat_ * plain_.weight_stride, plain_.inputs + beat_ * plain_.input_stride,
               b.rows, plain_.sums);
  if (b.first_normalised < b.last_normalised)
    beats_.normalise(plain_.row + b.first_normalised, plain_.row + b.last_normalised);
  if (b.first_pulled < b.last_pulled)
    beats_.move(plain_.row + b.first_pulled, plain_.row + b.last_pulled);
  beat_ += 1;
  result_.cycles += 1;
}

void ClockedEngine::entered() {
  plain_.beat = nullptr;
  if (segment_ < Segment::first_phase) return;
  const auto phase = static_cast<std::size_t>(segment_ - Segment::first_phase);
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  firing_ = {phase / per_cell, phase % per_cell, phase % per_cell + 1};
  if (plan_.schedule == spec::Schedule::synchronous) firing_ = {0, 0, per_cell};
  if (!beats_.plain() || firing_.last_p > firing_.first_p + 1) return;
  const ClockedBank& bank = layout_.banks[firing_.bank];
  const std::size_t row = bank.first_row + firing_.first_p * bank.width;
  plain_ = {bank.beat.data(),
            beats_.tap_adder(),
            &beats_.at.weight[bank.first_weight + firing_.first_p * bank.taps * bank.width],
            beats_.inputs(),
            &beats_.at.sum[row],
            row,
            bank.width,
            bank.input_stride()};
}

void ClockedEngine::do_beats(std::uint64_t first, std::uint64_t last) {
  if (segment_ >= Segment::first_phase)
    do_phase(first, last);
  else
    do_prepare(first, last);
}

void ClockedEngine::do_prepare(std::uint64_t first, std::uint64_t last) {
  for (const ClockedBank& bank : layout_.banks) {
    if (first == 0) beats_.begin_norms(bank);
    beats_.add_norms(bank, first, last);
    if (last == cycles_.prepare) beats_.invert(bank);
  }
}

// Accumulate, normalise, R u, publish: each row when its own beats are over, but all publish in the last one.
void ClockedEngine::do_phase(std::uint64_t first, std::uint64_t last) {
  const ClockedBank& bank = layout_.banks[firing_.bank];
  if (first == 0) beats_.take_links(bank, firing_.first_p == 0);
  const auto normalised = bank.with_beats_over(first, last, drive_cycles_);
  const auto pulled = bank.with_beats_over(first, last, change_cycles_);
  for (std::size_t p = firing_.first_p; p < firing_.last_p; ++p) {
    const std::size_t row = bank.first_row + p * bank.width;
    if (first == 0) beats_.begin_sums(bank, p);
    beats_.add_beats(bank, p, first, last);
    if (normalised.first < normalised.second)
      beats_.normalise(row + normalised.first, row + normalised.second);
    if (pulled.first < pulled.second) beats_.move(row + pulled.first, row + pulled.second);
    if (last < length_) continue;
    beats_.detect(bank, p, by_sum(), detected_);
    beats_.publish(bank, p, momentum(), detected_);
  }
}

std::vector<Probe> ClockedEngine::probes(const std::vector<std::size_t>& cells) const {
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  const spec::NeuronSignals signals = spec::neuron_signals(plan_.formats, plan_.output);
  const auto phase = spec::phase_of_neurons(topology_, phases_);
  std::vector<Probe> all;
  for (std::size_t c : cells)
    for (std::size_t p = 0; p < per_cell; ++p) {
      const std::size_t row = row_[c * per_cell + p];
      const int fires = static_cast<int>(phase[c * per_cell + p]);
      std::vector<std::string> scopes{spec::cell_scope(c), spec::neuron_scope(p), spec::accumulator_scope};
      all.push_back({scopes, signals.sum, &beats_.at.sum[row], nullptr, fires});
      all.push_back({scopes, signals.norm, &beats_.at.norm[row], nullptr, Probe::in_prepare});
      scopes.back() = spec::output_scope;
      all.push_back({scopes, signals.drive, &beats_.at.drive[row], nullptr, fires});
      all.push_back({scopes, signals.change, &beats_.at.change[row], nullptr, fires});
      all.push_back({scopes, signals.state, nullptr, &beats_.at.state[row], fires});
      if (has_momentum())
        all.push_back({scopes, signals.extrapolated, nullptr, &beats_.at.extrapolated[row], Probe::in_all});
    }
  return all;
}

} // namespace hopmesh::engine
