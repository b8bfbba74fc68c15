#include "sim/engine/kernels/fast_plan.h"

#include "sim/engine/generic/lanes.h"

namespace hopmesh::engine {

int bit_length(std::uint64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(x);
}

int norm_bits(const Plan& plan) {
  const auto most_weight = std::uint64_t{1} << (plan.formats.weight.width - 1);
  const auto most_bias = std::uint64_t{1} << (plan.formats.bias.width - 1);
  return bit_length(((plan.most_taps * most_weight) << plan.weight_up) + (most_bias << plan.bias_up));
}

Normalise normalise_of(const Plan& plan) {
  return plan.binary                                       ? Normalise::sign
         : plan.normaliser == spec::Normaliser::reciprocal ? Normalise::multiply
         : plan.normaliser == spec::Normaliser::divider    ? Normalise::divide
                                                           : Normalise::scale;
}

int multiplier_places(const Plan& plan) {
  return norm_bits(plan) + plan.reciprocal_bits - 2 - plan.ratio_up;
}

namespace {

std::string why_no_normaliser(const Plan& plan) {
  if (plan.binary) return "";
  const int row = norm_bits(plan), sum = plan.formats.accumulator.width;
  if (plan.normaliser == spec::Normaliser::reciprocal) {
    const int above = plan.formats.drive.fraction_bits() - plan.ratio_up; // from N's last place to s's
    const int product = std::max(above, 0) + row + plan.reciprocal_bits;
    if (product > 61 || row + plan.reciprocal_bits > 61)
      return "s times the reciprocal needs more than 62 bits";
    if (multiplier_places(plan) < 1) return "the reciprocal is coarser than the drive";
  } else if (plan.normaliser == spec::Normaliser::divider) {
    if (plan.formats.drive.rounding == spec::Rounding::rnd_conv) return "SC_RND_CONV behind a divider";
    if (plan.ratio_up < 0 || sum + plan.ratio_up > 50 || plan.formats.drive.fraction_bits() + row > 47)
      return "a quotient of more than 50 bits";
  } else {
    const auto overflow = plan.formats.drive.overflow;
    if (overflow == spec::Overflow::wrap || overflow == spec::Overflow::sat_zero)
      return "a drive that does not saturate, behind prescaled rows";
    if (plan.scaled_down < 0) return "a drive finer than the accumulator";
  }
  return "";
}

} // namespace

std::string why_no_kernel(const Plan& plan) {
  if (plan.formats.weight.width > 16) return "weights of more than 16 bits";
  if (plan.formats.link.width > 16) return "links of more than 16 bits";
  if (!plan.exact) return "an accumulator that rounds";
  if (plan.product_up > 0) return "a bias finer than a product";
  if (plan.most_taps > UINT16_MAX) return "rows of more than 65535 inputs"; // 31 bits hold their sum of |w|
  return why_no_normaliser(plan);
}

KernelRounding kernel_rounding(int places, spec::Rounding mode) {
  const LaneRounding r = lane_rounding(places, mode);
  return {r.add, r.add_if_negative, r.add_if_odd, r.places};
}

// Toward zero and away from it by turning negative numbers round; down at a tie by turning all of them.
KernelDivision kernel_division(int ratio_up, spec::Rounding mode) {
  KernelDivision d;
  d.ratio_up = ratio_up;
  const bool by_sign =
      mode == spec::Rounding::trn_zero || mode == spec::Rounding::rnd_inf || mode == spec::Rounding::rnd_zero;
  d.flip_by_sign = by_sign ? -1 : 0;
  d.flip_always = mode == spec::Rounding::rnd_min_inf || mode == spec::Rounding::rnd_zero ? -1 : 0;
  d.half = mode == spec::Rounding::trn || mode == spec::Rounding::trn_zero ? 0 : 0.5;
  return d;
}

} // namespace hopmesh::engine
