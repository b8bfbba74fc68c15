#include "sim/engine/clocked/clocked_fold.h"

#include "sim/engine/clocked/clocked_loops.h"
#include "sim/engine/overflow.h"
#include "sim/engine/row_walk.h"

#include <cstdlib>

namespace hopmesh::engine {

using spec::Segment;

Follower::Part Follower::in_cycle(std::uint64_t cycle, const spec::Rounds& rounds) {
  if (round_ == rounds.size()) return {};
  const spec::Round& round = rounds[round_];
  if (cycle != round.leaves + element_ + depth_) return {};
  const Part part{&round, element_, shared_ ? element_ + 1 : round.count};
  element_ = part.last;
  if (element_ == round.count) round_ += 1, element_ = 0;
  return part;
}

ClockedFold::ClockedFold(const spec::ArraySpec& array, const spec::Topology& topology)
    : ClockStepped(array, topology), array_(array), fold_(spec::fold_of(array, topology, phases_)),
      path_(plan_), wide_sum_(plan_),
      to_state_(shift_rounding(plan_.formats.drive.fraction_bits(), plan_.formats.state.rounding)),
      to_link_(shift_rounding(plan_.link_down, plan_.formats.link.rounding)),
      gained_(shift_rounding(spec::momentum_down, plan_.formats.state.rounding)),
      step_(step_rounding(plan_.step_down, plan_.formats.state)),
      lanes_(static_cast<std::size_t>(array.lanes)), shared_(spec::shares_stage(array)) {
  place_neurons();
  find_sources();
  const std::size_t neurons = topology.neurons();
  if (array.schedule == spec::Schedule::synchronous) write_bank_ = neurons;
  bias_.assign(neurons, 0);
  state_ = bias_;
  if (has_momentum()) extrapolated_ = bias_;
  link_.assign(neurons + write_bank_, 0);
  norm_.assign(neurons, 0);
  reciprocal_ = multiplier_ = sum_ = drive_ = norm_;
  places_.assign(neurons, 0);
  std::size_t most = 0;
  for (const auto& phase : phases_) most = std::max(most, phase.size());
  element_.sum.assign(std::min(most, static_cast<std::size_t>(array.elements)), 0);
  element_.neuron = element_.norm = element_.held = element_.sum;
  stage_.drive.assign(shared_ ? 1 : element_.sum.size(), 0);
  stage_.neuron = stage_.change = stage_.drive;
}

void ClockedFold::place_neurons() {
  position_.resize(topology_.neurons());
  for (const auto& phase : fold_.order) {
    first_position_.push_back(neuron_.size());
    for (std::uint32_t neuron : phase) {
      position_[neuron] = static_cast<std::uint32_t>(neuron_.size());
      neuron_.push_back(neuron);
    }
  }
}

void ClockedFold::find_sources() {
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  const auto add_cell = [&](std::size_t cell) {
    for (std::size_t q = 0; q < per_cell; ++q) source_.push_back(position_[cell * per_cell + q]);
  };
  for (std::uint32_t neuron : neuron_) {
    first_tap_.push_back(source_.size());
    const std::size_t cell = neuron / per_cell;
    add_cell(cell);
    for (std::size_t k = topology_.first_link[cell]; k < topology_.first_link[cell + 1]; ++k)
      add_cell(topology_.link_to[k]);
  }
  first_tap_.push_back(source_.size());
  weight_.assign(source_.size(), 0);
}

// ---- the host ----

void ClockedFold::write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) {
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  walk_rows(topology_, first, count,
            [&](std::size_t cell, std::size_t p, std::size_t tap, std::size_t piece) {
              const std::size_t at = first_tap_[position_[cell * per_cell + p]] + tap;
              for (std::size_t k = 0; k < piece; ++k)
                weight_[at + k] = kept_bits(*words++, plan_.formats.weight);
            });
}

void ClockedFold::write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    bias_[position_[first + k]] = kept_bits(words[k], plan_.formats.bias);
}

void ClockedFold::write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) {
  const auto one = static_cast<std::int32_t>(plan_.one_state);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = position_[first + k];
    state_[at] = std::min(std::max(kept_bits(words[k], plan_.formats.state), -one), one);
    if (has_momentum()) extrapolated_[at] = state_[at];
    link_[bank_ + at] = static_cast<std::int32_t>(rounded<std::int64_t>(state_[at], to_link_));
  }
}

void ClockedFold::restart() {
  extrapolated_ = state_;
  show(state_.data(), to_link_, state_.size(), &link_[bank_]);
}

// ---- clocks ----

void ClockedFold::entered() {
  adding_ = 0;
  published_.begin(array_, segment_ == Segment::prepare ? fold_.prepare_depth : spec::stage_cycles(array_));
  driven_.begin(array_, spec::drive_cycles(array_));
  pulled_.begin(array_, spec::change_cycles(array_));
}

void ClockedFold::do_beats(std::uint64_t first, std::uint64_t last) {
  if (segment_ == Segment::prepare) {
    for (std::uint64_t cycle = first; cycle < last; ++cycle) do_prepare(cycle);
    return;
  }
  const spec::Rounds& rounds = fold_.rounds[static_cast<std::size_t>(segment_ - Segment::first_phase)];
  for (std::uint64_t cycle = first; cycle < last; ++cycle) do_phase(cycle, rounds);
  if (last == length_) std::swap(bank_, write_bank_);
}

const spec::Round* ClockedFold::adding(std::uint64_t cycle, const spec::Rounds& rounds) {
  while (adding_ < rounds.size() && cycle > rounds[adding_].leaves) ++adding_;
  return adding_ < rounds.size() && rounds[adding_].adds(cycle) ? &rounds[adding_] : nullptr;
}

void ClockedFold::do_prepare(std::uint64_t cycle) {
  if (const spec::Round* round = adding(cycle, fold_.prepare))
    for (std::size_t e = 0; e < round->count; ++e) {
      const std::size_t at = position(*round, e);
      element_.neuron[e] = neuron_[at];
      if (cycle == round->begins)
        element_.norm[e] = plan_.hold > 0 ? 0 : std::abs(std::int64_t{bias_[at]}) << plan_.bias_up;
      add_magnitudes(at, (cycle - round->begins) * lanes_, element_.norm[e]);
    }
  if (adding_ < fold_.prepare.size() && cycle == fold_.prepare[adding_].leaves) {
    const spec::Round& round = fold_.prepare[adding_];
    for (std::size_t e = 0; e < round.count; ++e) {
      norm_[position(round, e)] = element_.norm[e];
      if (shared_) element_.held[e] = element_.norm[e];
    }
  }
  const Follower::Part written = published_.in_cycle(cycle, fold_.prepare);
  for (std::size_t e = written.first; e < written.last; ++e) {
    const std::size_t at = position(*written.round, e);
    const DrivePath::Inverse inverse = path_.invert(static_cast<std::uint64_t>(norm_[at]));
    if (norm_[at] != 0) reciprocal_[at] = inverse.reciprocal; // else it keeps what it has, as in hardware
    multiplier_[at] = inverse.multiplier;
    places_[at] = inverse.places;
  }
}

// The end of the stage comes first: registers are read before somebody else writes them.
void ClockedFold::do_phase(std::uint64_t cycle, const spec::Rounds& rounds) {
  const bool at_once = spec::changes_at_once(array_);
  if (!at_once) publish(published_.in_cycle(cycle, rounds));
  const Follower::Part pulled = pulled_.in_cycle(cycle, rounds);
  if (pulled.round) {
    move(position(*pulled.round, pulled.first), pulled.last - pulled.first,
         &stage_.change[stage_of(pulled.first)]);
  }
  if (at_once) publish(published_.in_cycle(cycle, rounds));
  const Follower::Part driven = driven_.in_cycle(cycle, rounds);
  for (std::size_t e = driven.first; e < driven.last; ++e) normalise(position(*driven.round, e), stage_of(e));
  if (const spec::Round* round = adding(cycle, rounds))
    for (std::size_t e = 0; e < round->count; ++e) {
      const std::size_t at = position(*round, e);
      element_.neuron[e] = neuron_[at];
      if (cycle == round->begins)
        element_.sum[e] =
            plan_.exact ? std::int64_t{bias_[at]} << -plan_.bias_down : wide_sum_.begin(bias_[at]);
      add_taps(at, (cycle - round->begins) * lanes_, element_.sum[e]);
    }
  if (adding_ < rounds.size() && cycle == rounds[adding_].leaves) leave(rounds[adding_]);
}

void ClockedFold::add_taps(std::size_t at, std::size_t first_tap, std::int64_t& sum) const {
  const std::size_t first = first_tap_[at] + first_tap, last = std::min(first + lanes_, first_tap_[at + 1]);
  if (first >= last) return;
  const std::int32_t* links = &link_[bank_];
  std::int64_t products = 0;
  for (std::size_t t = first; t < last; ++t) products += std::int64_t{weight_[t]} * links[source_[t]];
  sum = plan_.exact ? sum + products * (std::int64_t{1} << plan_.product_up) : wide_sum_.add(sum, products);
}

void ClockedFold::add_magnitudes(std::size_t at, std::size_t first_tap, std::int64_t& norm) const {
  const std::size_t first = first_tap_[at] + first_tap, last = std::min(first + lanes_, first_tap_[at + 1]);
  const bool own = plan_.output == spec::Output::projected;
  for (std::size_t t = first; t < last; ++t)
    if (!own || source_[t] == at) norm += std::abs(std::int64_t{weight_[t]}) << plan_.weight_up;
}

void ClockedFold::leave(const spec::Round& round) {
  for (std::size_t e = 0; e < round.count; ++e) {
    sum_[position(round, e)] = element_.sum[e];
    if (shared_) element_.held[e] = element_.sum[e];
  }
}

void ClockedFold::normalise(std::size_t at, std::size_t stage) {
  drive_[at] = path_.drive({&norm_[at], &multiplier_[at], &places_[at]}, sum_[at]);
  stage_.drive[stage] = drive_[at];
  stage_.neuron[stage] = neuron_[at];
}

void ClockedFold::move(std::size_t at, std::size_t count, std::int64_t* changes) const {
  const auto& base = has_momentum() ? extrapolated_ : state_;
  if (plan_.hold > 0)
    step_from(&drive_[at], &base[at], &state_[at], plan_.one_state, step_, count, changes);
  else
    pull(&drive_[at], &state_[at], plan_.one_state, to_state_, count, changes);
}

void ClockedFold::detect(std::size_t at, std::size_t count, const std::int64_t* changes) {
  const auto& base = has_momentum() ? extrapolated_ : state_;
  if (by_sum())
    detected_.largest_sum =
        std::max(detected_.largest_sum,
                 largest_moving(&sum_[at], &base[at], plan_.least_at_one, plan_.most_at_minus_one, count));
  if (has_momentum()) detected_.along += along(&sum_[at], changes, count);
  for (std::size_t k = 0; k < count; ++k)
    detected_.largest_change = std::max(detected_.largest_change, std::abs(changes[k]));
}

void ClockedFold::publish(const Follower::Part& part) {
  if (!part.round) return;
  const std::size_t at = position(*part.round, part.first), count = part.last - part.first;
  const std::int64_t* changes = &stage_.change[stage_of(part.first)];
  detect(at, count, changes);
  if (has_momentum())
    add_changes_ahead(changes, {plan_.one_state, momentum(), step_, gained_, to_link_}, count, &state_[at],
                      &extrapolated_[at], &link_[write_bank_ + at]);
  else
    add_changes(changes, to_link_, count, &state_[at], &link_[write_bank_ + at]);
}

std::vector<Probe> ClockedFold::probes(const std::vector<std::size_t>& cells) const {
  const spec::NeuronSignals signals = spec::neuron_signals(plan_.formats, plan_.output);
  std::vector<Probe> all;
  const auto add = [&all](const std::vector<std::string>& scopes, const spec::Signal& signal,
                          const std::int64_t& code) {
    all.push_back({scopes, signal, &code, nullptr, Probe::in_all});
  };
  const auto add_stage = [&](std::vector<std::string> scopes, std::size_t s) {
    scopes.emplace_back(spec::stage_scope);
    add(scopes, spec::worked_signal, stage_.neuron[s]);
    scopes.emplace_back(spec::output_scope);
    add(scopes, signals.drive, stage_.drive[s]);
    add(scopes, signals.change, stage_.change[s]);
  };
  for (std::size_t e = 0; e < elements(); ++e) {
    const std::string element = spec::element_scope(e);
    add({element}, spec::worked_signal, element_.neuron[e]);
    if (shared_) add({element}, spec::held_signal, element_.held[e]);
    add({element, spec::accumulator_scope}, signals.sum, element_.sum[e]);
    add({element, spec::accumulator_scope}, signals.norm, element_.norm[e]);
    if (!shared_) add_stage({element}, e);
  }
  if (shared_) add_stage({}, 0);
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  const auto phase = spec::phase_of_neurons(topology_, phases_);
  for (std::size_t c : cells)
    for (std::size_t p = 0; p < per_cell; ++p) {
      const std::size_t neuron = c * per_cell + p;
      all.push_back({{spec::cell_scope(c), spec::neuron_scope(p)},
                     signals.state,
                     nullptr,
                     &state_[position_[neuron]],
                     static_cast<int>(phase[neuron])});
      if (has_momentum())
        all.push_back({{spec::cell_scope(c), spec::neuron_scope(p)},
                       signals.extrapolated,
                       nullptr,
                       &extrapolated_[position_[neuron]],
                       Probe::in_all});
    }
  return all;
}

} // namespace hopmesh::engine
