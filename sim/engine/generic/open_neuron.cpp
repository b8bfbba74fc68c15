#include "sim/engine/generic/open_neuron.h"

#include "sim/engine/division.h"

#include <algorithm>
#include <cstdlib>

namespace hopmesh::engine {

OpenNeuron::OpenNeuron(const spec::ArraySpec& array, std::size_t taps)
    : plan_(array, taps, 1), sums_norm_(spec::sums_norm(array)), path_(plan_), sum_(plan_),
      to_state_(shift_rounding(plan_.formats.drive.fraction_bits(), plan_.formats.state.rounding)),
      to_link_(shift_rounding(plan_.link_down, plan_.formats.link.rounding)),
      gained_(shift_rounding(spec::momentum_down, plan_.formats.state.rounding)),
      step_(step_rounding(plan_.step_down, plan_.formats.state)) {}

std::vector<std::int64_t> OpenNeuron::sums(const spec::FiringInputs& in) const {
  const std::size_t taps = in.weight.size(), lanes = static_cast<std::size_t>(plan_.lanes);
  std::int64_t s = sum_.begin(in.bias);
  std::vector<std::int64_t> all{s};
  for (std::size_t first = 0; first < taps; first += lanes) {
    std::int64_t products = 0;
    for (std::size_t t = first; t < std::min(taps, first + lanes); ++t)
      products += std::int64_t{in.weight[t]} * in.link[t];
    all.push_back(s = sum_.add(s, products));
  }
  return all;
}

std::uint64_t OpenNeuron::norm(const spec::FiringInputs& in) const {
  const auto size = [](std::int32_t code) {
    return static_cast<std::uint64_t>(std::abs(std::int64_t{code}));
  };
  if (plan_.output == spec::Output::projected) return size(in.weight[in.own_tap]) << plan_.weight_up;
  std::uint64_t weights = 0;
  for (std::int32_t w : in.weight) weights += size(w);
  const std::uint64_t bias = plan_.output == spec::Output::momentum ? 0 : size(in.bias);
  return (weights << plan_.weight_up) + (bias << plan_.bias_up);
}

spec::FiringSteps OpenNeuron::fire(const spec::FiringInputs& in) const {
  spec::FiringSteps steps;
  steps.sum = sums(in);
  const std::uint64_t n = sums_norm_ ? norm(in) : 0;
  const DrivePath::Inverse inverse = path_.invert(n);
  steps.norm = static_cast<std::int64_t>(n);
  steps.reciprocal = inverse.reciprocal;
  if (inverse.reciprocal != 0) steps.places = bit_length(n) + plan_.reciprocal_bits - 2 - plan_.ratio_up;
  const DrivePath::Rows row{&steps.norm, &inverse.multiplier, &inverse.places};
  steps.ratio = path_.unlimited_drive(row, steps.sum.back());
  steps.drive = path_.drive(row, steps.sum.back());
  if (plan_.hold > 0)
    step(in, steps);
  else
    pull(in, steps);
  return steps;
}

void OpenNeuron::pull(const spec::FiringInputs& in, spec::FiringSteps& steps) const {
  const std::int64_t one = plan_.one_state;
  steps.pull = steps.drive >= 0 ? one - in.state : one + in.state;
  steps.product = steps.pull * steps.drive;
  steps.change = rounded(steps.product, to_state_);
  steps.state = static_cast<std::int32_t>(in.state + steps.change);
  steps.link = static_cast<std::int32_t>(rounded(std::int64_t{steps.state}, to_link_));
}

void OpenNeuron::step(const spec::FiringInputs& in, spec::FiringSteps& steps) const {
  const bool momentum = plan_.output == spec::Output::momentum;
  const auto held = [one = plan_.one_state](std::int64_t code) { return std::clamp(code, -one, one); };
  const std::int64_t by = rounded(shifted_up(steps.drive, step_.up), step_.down);
  std::int64_t shown = held((momentum ? in.extrapolated : in.state) + by);
  steps.state = static_cast<std::int32_t>(shown);
  steps.change = shown - in.state;
  if (momentum) {
    steps.product = in.momentum * steps.change;
    shown = held(shown + rounded(steps.product, gained_));
    steps.extrapolated = static_cast<std::int32_t>(shown);
  }
  steps.link = static_cast<std::int32_t>(rounded(shown, to_link_));
}

} // namespace hopmesh::engine
