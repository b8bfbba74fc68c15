#include "sim/engine/clocked/clocked_beats.h"

#include "sim/engine/clocked/clocked_loops.h"

#include <cstdlib>

namespace hopmesh::engine {

ClockedBeats::ClockedBeats(const NeuronPlan& plan, const ClockedLayout& layout)
    : plan_(plan), layout_(layout), path_(plan), wide_sum_(plan), sum_limit_(plan.formats.accumulator),
      to_state_(shift_rounding(plan.formats.drive.fraction_bits(), plan.formats.state.rounding)),
      to_link_(shift_rounding(plan.link_down, plan.formats.link.rounding)),
      gained_(shift_rounding(spec::momentum_down, plan.formats.state.rounding)),
      step_(step_rounding(plan.step_down, plan.formats.state)),
      short_(plan.formats.weight.width + plan.formats.link.width <= 32),
      plain_sums_(plan.exact && plan.product_up == 0), narrow_sums_(!plan.exact && plan.sum_up <= 52),
      per_cell_(static_cast<std::size_t>(plan.neurons_per_cell)),
      lanes_(static_cast<std::size_t>(plan.lanes)), in_(layout.inputs, 0) {
  if (narrow_sums_) to_sum_ = shift_rounding(plan.sum_up, plan.formats.accumulator.rounding);
  at.weight.assign(layout.weights, 0);
  at.bias.assign(layout.rows, 0);
  at.state = at.bias;
  if (plan.output == spec::Output::momentum) at.extrapolated = at.bias;
  at.link.assign(layout.rows + lane_count, 0);
  at.norm.assign(layout.rows, 0);
  at.reciprocal = at.sum = at.drive = at.change = multiplier_ = at.norm;
  places_.assign(layout.rows, 0);
}

void ClockedBeats::load(std::size_t cell, std::size_t p, std::int32_t state) {
  const std::size_t row = layout_.row(cell, p);
  at.state[row] = state;
  if (!at.extrapolated.empty()) at.extrapolated[row] = state;
  at.link[row] = static_cast<std::int32_t>(rounded<std::int64_t>(state, to_link_));
}

void ClockedBeats::begin_norms(const ClockedBank& bank) {
  for (std::size_t r = bank.first_row; r < bank.first_row + per_cell_ * bank.width; ++r)
    at.norm[r] = plan_.hold > 0 ? 0 : std::abs(std::int64_t{at.bias[r]}) << plan_.bias_up;
}

void ClockedBeats::add_norms(const ClockedBank& bank, std::uint64_t first, std::uint64_t last) {
  if (first >= bank.beats()) return;
  const std::size_t tap = first * lanes_, end = std::min<std::size_t>(last * lanes_, bank.taps);
  if (plan_.output == spec::Output::projected) return add_own_taps(bank, tap, end);
  for (std::size_t p = 0; p < per_cell_; ++p)
    add_magnitudes(&at.weight[bank.first_weight + (p * bank.taps + tap) * bank.width], bank.width, end - tap,
                   plan_.weight_up, bank.reach[first], &at.norm[bank.first_row + p * bank.width]);
}

// Of taps [tap, end), those that are the neuron itself.
void ClockedBeats::add_own_taps(const ClockedBank& bank, std::size_t tap, std::size_t end) {
  for (std::size_t p = tap; p < std::min(end, per_cell_); ++p)
    add_magnitudes(&at.weight[bank.first_weight + (p * bank.taps + p) * bank.width], bank.width, 1,
                   plan_.weight_up, bank.width, &at.norm[bank.first_row + p * bank.width]);
}

void ClockedBeats::invert(const ClockedBank& bank) {
  for (std::size_t r = bank.first_row; r < bank.first_row + per_cell_ * bank.width; ++r) {
    const DrivePath::Inverse inverse = path_.invert(static_cast<std::uint64_t>(at.norm[r]));
    if (at.norm[r] != 0) at.reciprocal[r] = inverse.reciprocal; // else it keeps what it has, as in hardware
    multiplier_[r] = inverse.multiplier;
    places_[r] = inverse.places;
  }
}

void ClockedBeats::take_links(const ClockedBank& bank, bool neighbours) {
  std::int32_t* inputs = in_.data();
  for (std::size_t p = 0; p < per_cell_; ++p, inputs += bank.input_stride())
    std::copy_n(&at.link[bank.first_row + p * bank.width], bank.width, inputs);
  if (!neighbours) return;
  for (const std::vector<LinkRun>& runs : bank.runs) {
    copy_runs(at.link.data(), runs.data(), runs.size(), per_cell_, bank.input_stride(), inputs);
    inputs += per_cell_ * bank.input_stride();
  }
}

void ClockedBeats::begin_sums(const ClockedBank& bank, std::size_t p) {
  const std::size_t row = bank.first_row + p * bank.width;
  if (plan_.exact) return engine::begin_sums(&at.bias[row], -plan_.bias_down, bank.width, &at.sum[row]);
  for (std::size_t r = row; r < row + bank.width; ++r) at.sum[r] = wide_sum_.begin(at.bias[r]);
}

// A rounding accumulator writes its register once a beat; an exact one may as well take all beats at once.
void ClockedBeats::add_beats(const ClockedBank& bank, std::size_t p, std::uint64_t first,
                             std::uint64_t last) {
  last = std::min<std::uint64_t>(last, bank.beats());
  const std::uint64_t together = plain_sums_ ? bank.beats() : 1;
  for (std::uint64_t beat = first; beat < last; beat += together) {
    const std::size_t tap = beat * lanes_,
                      end = std::min(std::min(beat + together, last) * lanes_, bank.taps);
    const Taps taps{&at.weight[bank.first_weight + (p * bank.taps + tap) * bank.width], bank.width,
                    &in_[tap * bank.input_stride()], bank.input_stride(), end - tap};
    std::int64_t* sums = &at.sum[bank.first_row + p * bank.width];
    if (plain_sums_)
      add(taps, 0, bank.reach[beat], sums);
    else
      add_rounded(taps, bank.reach[beat], sums);
  }
}

ClockedBeats::TapAdder ClockedBeats::tap_adder() const {
  return short_ ? &add_short_tap : &add_tap;
}

void ClockedBeats::add(const Taps& taps, std::size_t row, std::size_t rows, std::int64_t* sums) const {
  const auto products = short_ ? &add_short_products : &add_products;
  const auto tap = tap_adder();
  const std::int32_t *weights = taps.weights + row, *inputs = taps.inputs + row;
  std::size_t r = 0;
  for (; taps.count > 1 && r + lane_count <= rows; r += lane_count)
    products(weights + r, taps.weight_stride, inputs + r, taps.input_stride, taps.count, sums + r);
  if (r == rows) return;
  for (std::size_t t = 0; t < taps.count; ++t)
    tap(weights + t * taps.weight_stride + r, inputs + t * taps.input_stride + r, rows - r, sums + r);
}

void ClockedBeats::add_rounded(const Taps& taps, std::size_t rows, std::int64_t* sums) const {
  for (std::size_t r = 0; r < rows; r += lane_count) {
    alignas(64) std::int64_t products[lane_count] = {};
    const std::size_t count = std::min(rows - r, lane_count);
    add(taps, r, count, products);
    if (narrow_sums_ && count == lane_count) {
      shift_and_add_lanes(sums + r, plan_.sum_up, products, plan_.product_up);
      round_lanes(sums + r, to_sum_);
      limit_lanes(sums + r, sum_limit_);
    } else {
      for (std::size_t l = 0; l < count; ++l) sums[r + l] = wide_sum_.add(sums[r + l], products[l]);
    }
  }
}

void ClockedBeats::normalise(std::size_t first, std::size_t last) {
  const auto rows = [this](std::size_t r) {
    return DrivePath::Rows{&at.norm[r], &multiplier_[r], &places_[r]};
  };
  for (; last - first >= lane_count; first += lane_count)
    path_.drives(rows(first), &at.sum[first], &at.drive[first]);
  for (; first < last; ++first) at.drive[first] = path_.drive(rows(first), at.sum[first]);
}

void ClockedBeats::move(std::size_t first, std::size_t last) {
  if (first >= last) return;
  const auto& base = at.extrapolated.empty() ? at.state : at.extrapolated;
  if (plan_.hold > 0)
    step_from(&at.drive[first], &base[first], &at.state[first], plan_.one_state, step_, last - first,
              &at.change[first]);
  else
    pull(&at.drive[first], &at.state[first], plan_.one_state, to_state_, last - first, &at.change[first]);
}

void ClockedBeats::detect(const ClockedBank& bank, std::size_t p, bool by_sum, Detected& detected) const {
  const std::size_t row = bank.first_row + p * bank.width;
  const auto& base = at.extrapolated.empty() ? at.state : at.extrapolated;
  if (by_sum)
    detected.largest_sum =
        std::max(detected.largest_sum, largest_moving(&at.sum[row], &base[row], plan_.least_at_one,
                                                      plan_.most_at_minus_one, bank.width));
  if (!at.extrapolated.empty()) detected.along += along(&at.sum[row], &at.change[row], bank.width);
}

void ClockedBeats::publish(const ClockedBank& bank, std::size_t p, std::int32_t momentum,
                           Detected& detected) {
  const std::size_t row = bank.first_row + p * bank.width;
  if (at.extrapolated.empty()) {
    detected.largest_change =
        std::max(detected.largest_change,
                 add_changes(&at.change[row], to_link_, bank.width, &at.state[row], &at.link[row]));
    return;
  }
  add_changes_ahead(&at.change[row], {plan_.one_state, momentum, step_, gained_, to_link_}, bank.width,
                    &at.state[row], &at.extrapolated[row], &at.link[row]);
  for (std::size_t r = row; r < row + bank.width; ++r)
    detected.largest_change = std::max(detected.largest_change, std::abs(at.change[r]));
}

void ClockedBeats::restart() {
  at.extrapolated = at.state;
  show(at.state.data(), to_link_, layout_.rows, at.link.data());
}

} // namespace hopmesh::engine
