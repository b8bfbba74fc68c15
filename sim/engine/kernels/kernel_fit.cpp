#include "sim/engine/kernels/kernel_fit.h"

namespace hopmesh::engine {

Normalise normalise_of(const NeuronPlan& plan) {
  return plan.binary                                       ? Normalise::sign
         : plan.normaliser == spec::Normaliser::reciprocal ? Normalise::multiply
         : plan.normaliser == spec::Normaliser::divider    ? Normalise::divide
                                                           : Normalise::scale;
}

namespace {

std::string why_no_normaliser(const NeuronPlan& plan) {
  if (plan.binary) return "";
  const int row = plan.norm_bits, sum = plan.formats.accumulator.width;
  if (plan.normaliser == spec::Normaliser::reciprocal) {
    const int above = plan.formats.drive.fraction_bits() - plan.ratio_up; // from N's last place to s's
    const int product = std::max(above, 0) + row + plan.reciprocal_bits;
    if (product > 61 || row + plan.reciprocal_bits > 61)
      return "s times the reciprocal needs more than 62 bits";
    if (plan.multiplier_places < 1) return "the reciprocal is coarser than the drive";
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

std::string why_no_kernel(const NeuronPlan& plan) {
  if (plan.formats.weight.width > 16) return "weights of more than 16 bits";
  if (plan.formats.link.width > 16) return "links of more than 16 bits";
  if (!plan.exact) return "an accumulator that rounds";
  if (plan.product_up > 0) return "a bias finer than a product";
  if (plan.most_taps > UINT16_MAX) return "rows of more than 65535 inputs"; // 31 bits hold their sum of |w|
  return why_no_normaliser(plan);
}

// As round_quotient, but n / N for 2 n / 2 N: a one of the rule is half a one of n. With the quarter, the
// exact value keeps 1 / 4 N away from whole numbers. Doubles err by less, since s and the quotient have few
// enough bits (docs/hardware/engine.md).
KernelDivision kernel_division(int ratio_up, spec::Rounding mode) {
  const RoundingRule rule = rounding_rule(mode);
  const auto halves = [](std::int64_t count) { return 0.5 * static_cast<double>(count); };
  return {0.25 + halves(rule.ones), halves(rule.ones_if_negative), rule.half ? 0.5 : 0.0,
          rule.unit_if_negative ? 1.0 : 0.0, ratio_up};
}

} // namespace hopmesh::engine
