#include "sim/engine/kernels/kernel_fit.h"

#include "sim/engine/division.h"

#include <cmath>

namespace hopmesh::engine {

Normalise normalise_of(const NeuronPlan& plan) {
  const bool divider = plan.normaliser == spec::Normaliser::divider;
  if (plan.output == spec::Output::projected)
    return divider ? Normalise::step_divide : Normalise::step_multiply;
  if (plan.output == spec::Output::momentum)
    return divider ? Normalise::ahead_divide : Normalise::ahead_multiply;
  return plan.binary                                       ? Normalise::sign
         : plan.normaliser == spec::Normaliser::reciprocal ? Normalise::multiply
         : divider                                         ? Normalise::divide
                                                           : Normalise::scale;
}

namespace {

// s is held within `hold` times its divisor, so a quotient is less than four.
std::string why_no_held_normaliser(const NeuronPlan& plan) {
  const int held = plan.norm_bits + bit_length(static_cast<std::uint64_t>(plan.hold * plan.gain) - 1);
  const int drive = plan.formats.drive.fraction_bits();
  if (plan.output == spec::Output::momentum && plan.formats.state.fraction_bits() > 29)
    return "a state of 30 places with momentum";
  if (plan.normaliser == spec::Normaliser::reciprocal) {
    if (held + plan.norm_up + plan.reciprocal_bits > 61)
      return "s times the reciprocal needs more than 62 bits";
    if (plan.multiplier_places < 1) return "the reciprocal is coarser than the drive";
  } else {
    if (plan.formats.drive.rounding == spec::Rounding::rnd_conv) return "SC_RND_CONV behind a divider";
    if (plan.ratio_up < 0 || held + drive > 50 || plan.norm_bits + plan.gain_places + drive + 2 > 47)
      return "a quotient of more than 50 bits";
  }
  return "";
}

std::string why_no_normaliser(const NeuronPlan& plan) {
  if (plan.binary) return "";
  if (plan.hold > 0) return why_no_held_normaliser(plan);
  const int row = plan.norm_bits, sum = plan.formats.accumulator.width;
  if (plan.normaliser == spec::Normaliser::reciprocal) {
    const int product = std::max(plan.norm_up, 0) + row + plan.reciprocal_bits;
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

// A product of s and r has so few bits that a double holds it, and what is added to round it.
bool fits_slim(const NeuronPlan& plan) {
  const auto adds_only = [](spec::Rounding mode) {
    return mode == spec::Rounding::rnd || mode == spec::Rounding::trn;
  };
  const spec::Formats& f = plan.formats;
  if (plan.output != spec::Output::momentum || f.state.fraction_bits() > 28) return false;
  if (!adds_only(f.drive.rounding) || !adds_only(f.state.rounding) || !adds_only(f.link.rounding))
    return false;
  if (plan.normaliser == spec::Normaliser::reciprocal)
    return plan.reciprocal_bits <= 20 && plan.multiplier_places <= 52;
  return 31 + plan.ratio_up <= 50;
}

KernelArgs arguments_of(const NeuronPlan& plan) {
  const spec::Formats& f = plan.formats;
  const Normalise how = normalise_of(plan);
  KernelArgs a{};
  a.synchronous = plan.schedule == spec::Schedule::synchronous;
  a.bias_up = -plan.bias_down;
  a.state_fraction = f.state.fraction_bits();
  a.one_drive = plan.one_drive;
  a.one_state = plan.one_state;
  a.at_one = plan.least_at_one;
  a.at_minus_one = plan.most_at_minus_one;
  if (how == Normalise::scale) a.drive = shift_rounding(plan.scaled_down, f.drive.rounding);
  if (how == Normalise::multiply || how == Normalise::step_multiply || how == Normalise::ahead_multiply)
    a.drive = shift_rounding(plan.multiplier_places, f.drive.rounding);
  if (divides(how)) a.division = kernel_division(plan.ratio_up, f.drive.rounding);
  a.state_rounding = shift_rounding(f.drive.fraction_bits(), f.state.rounding);
  a.link = shift_rounding(plan.link_down, f.link.rounding);
  a.step_up = std::max(-plan.step_down, 0);
  a.step = shift_rounding(std::max(plan.step_down, 0), f.state.rounding);
  a.gained = shift_rounding(spec::momentum_down, f.state.rounding);
  a.beyond_up = f.drive.fraction_bits() + 2;
  a.most_drive = plan.most_drive;
  a.gain = plan.gain;
  if (fits_slim(plan)) a.slim = slim_quotient(plan), a.slim_blocks = slim_blocks(plan);
  a.once.half = shift_rounding(32, f.drive.rounding).add;
  return a;
}

std::size_t slim_blocks(const NeuronPlan& plan) {
  const std::size_t changes = (std::size_t{1} << (30 - plan.formats.state.fraction_bits())) - 1;
  return std::max<std::size_t>(1, changes / static_cast<std::size_t>(plan.neurons_per_cell));
}

bool fits_brief(const NeuronPlan& plan) {
  return plan.normaliser != spec::Normaliser::reciprocal || plan.step_down <= 0;
}

KernelQuotient slim_quotient(const NeuronPlan& plan) {
  const KernelDivision division = kernel_division(plan.ratio_up, plan.formats.drive.rounding);
  return {std::ldexp(1.0, plan.ratio_up), division.to_dividend, division.to_quotient};
}

} // namespace hopmesh::engine
