#include "sim/engine/kernels/row_inverse.h"

#include "sim/engine/division.h"

#include <cmath>
#include <cstring>

namespace hopmesh::engine {

namespace {

bool multiplies(const NeuronPlan& plan) {
  return plan.normaliser == spec::Normaliser::reciprocal;
}

std::int64_t bits_of(double x) {
  std::int64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

// The reciprocal is moved up to the point that the widest divisor would give.
std::int64_t moved_up(const NeuronPlan& plan, std::uint64_t norm) {
  const std::int64_t r = reciprocal(norm, plan.reciprocal_bits) * plan.gain;
  return r << (plan.norm_bits - bit_length(norm));
}

} // namespace

RowInverse modified_inverse(const NeuronPlan& plan, std::uint64_t norm) {
  if (norm == 0) return {};
  return {multiplies(plan) ? moved_up(plan, norm) : bits_of(1.0 / static_cast<double>(norm)), 0};
}

RowInverse held_inverse(const NeuronPlan& plan, std::uint64_t norm) {
  const auto most_sum =
      static_cast<std::int64_t>((norm * static_cast<std::uint64_t>(plan.hold)) << plan.norm_up);
  if (multiplies(plan))
    return norm > 0 ? RowInverse{moved_up(plan, norm), most_sum}
                    : RowInverse{plan.most_drive << plan.multiplier_places, 1};
  return {norm > 0 ? bits_of(1.0 / static_cast<double>(norm << plan.gain_places)) : 0, most_sum};
}

RowInverse slim_inverse(const NeuronPlan& plan, std::uint64_t norm) {
  if (!multiplies(plan)) return {norm > 0 ? bits_of(1.0 / static_cast<double>(norm)) : 0, 0};
  if (norm == 0) return {bits_of(2.0 * static_cast<double>(plan.most_drive)), 0};
  const int places = bit_length(norm) + plan.reciprocal_bits - 2 - plan.ratio_up;
  return {bits_of(std::ldexp(static_cast<double>(reciprocal(norm, plan.reciprocal_bits)), -places)), 0};
}

} // namespace hopmesh::engine
