#include "sim/engine/neuron_plan.h"

#include "sim/engine/division.h"

namespace hopmesh::engine {

namespace {

int bits_of_norm(const NeuronPlan& plan) {
  const auto most_weight = std::uint64_t{1} << (plan.formats.weight.width - 1);
  const auto most_bias = std::uint64_t{1} << (plan.formats.bias.width - 1);
  const std::size_t weights = plan.output == spec::Output::projected ? 1 : plan.most_taps;
  const std::uint64_t bias = plan.hold > 0 ? 0 : most_bias << plan.bias_up;
  return bit_length(((weights * most_weight) << plan.weight_up) + bias);
}

// With a truncated reciprocal of at least 4 bits, s times r is at least three quarters of what s over the
// divisor is. So u is at its limit from c divisors on where 3/4 c gain >= limit.
int hold_of(spec::Output output, int gain) {
  if (output == spec::Output::momentum) return 2;
  return output == spec::Output::projected ? (42 + gain) / gain : 0;
}

// The code of the state nearest to zero that a link shows as the bound of this sign: rounding is monotone.
std::int64_t end_of_bound(const NeuronPlan& plan, std::int64_t sign) {
  const ShiftRounding to_link = shift_rounding(plan.link_down, plan.formats.link.rounding);
  std::int64_t least = 0, most = plan.one_state; // the link of sign * most is a bound, that of 0 is not
  while (most - least > 1) {
    const std::int64_t middle = (least + most) / 2;
    (rounded(sign * middle, to_link) == sign * plan.one_link ? most : least) = middle;
  }
  return sign * most;
}

} // namespace

NeuronPlan::NeuronPlan(const spec::ArraySpec& array, const spec::Topology& topology)
    : NeuronPlan(array, topology.most_taps(), topology.neurons_per_cell) {}

NeuronPlan::NeuronPlan(const spec::ArraySpec& array, std::size_t taps, int neurons_in_cell)
    : Points(spec::points_of(spec::built_formats(array, taps))), formats(spec::built_formats(array, taps)),
      schedule(array.schedule), normaliser(array.normaliser), lanes(array.lanes),
      reciprocal_bits(array.reciprocal_bits), neurons_per_cell(neurons_in_cell),
      exact(array.exact_accumulator), output(array.output), binary(array.output == spec::Output::binary),
      gain(output == spec::Output::projected ? array.relaxation : 1),
      gain_places(output == spec::Output::projected ? spec::relaxation_down : 0), hold(hold_of(output, gain)),
      most_taps(taps), norm_bits(bits_of_norm(*this)), norm_up(formats.drive.fraction_bits() - ratio_up),
      multiplier_places(norm_bits + reciprocal_bits - 2 - ratio_up + gain_places),
      one_state(formats.state.one_raw()), one_drive(formats.drive.one_raw()),
      one_link(formats.link.one_raw()),
      most_drive(output == spec::Output::projected ? 2 * one_drive : one_drive),
      least_at_one(end_of_bound(*this, 1)), most_at_minus_one(end_of_bound(*this, -1)) {}

} // namespace hopmesh::engine
