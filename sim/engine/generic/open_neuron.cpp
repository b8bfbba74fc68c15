#include "sim/engine/generic/open_neuron.h"

#include "sim/engine/division.h"

#include <algorithm>
#include <cstdlib>

namespace hopmesh::engine {

OpenNeuron::OpenNeuron(const spec::ArraySpec& array, std::size_t taps)
    : plan_(array, taps, 1), sums_norm_(spec::sums_norm(array)), path_(plan_), sum_(plan_),
      to_state_(shift_rounding(plan_.formats.drive.fraction_bits(), plan_.formats.state.rounding)),
      to_link_(shift_rounding(plan_.link_down, plan_.formats.link.rounding)) {}

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
  std::uint64_t weights = 0;
  for (std::int32_t w : in.weight) weights += size(w);
  return (weights << plan_.weight_up) + (size(in.bias) << plan_.bias_up);
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
  const std::int64_t one = plan_.one_state;
  steps.pull = steps.drive >= 0 ? one - in.state : one + in.state;
  steps.product = steps.pull * steps.drive;
  steps.change = rounded(steps.product, to_state_);
  steps.state = static_cast<std::int32_t>(in.state + steps.change);
  steps.link = static_cast<std::int32_t>(rounded(std::int64_t{steps.state}, to_link_));
  return steps;
}

} // namespace hopmesh::engine
