#include "sim/engine/kernels/row_inverse.h"

#include "sim/engine/division.h"

#include <cmath>
#include <cstdlib>
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

// Places of a reciprocal behind the point that makes u of s.
int places_behind(const NeuronPlan& plan, std::uint64_t norm) {
  return bit_length(norm) + plan.reciprocal_bits - 2 - plan.ratio_up;
}

} // namespace

std::uint64_t row_divisor(const NeuronPlan& plan, std::int32_t own, std::uint32_t sum, std::int32_t bias) {
  if (plan.output == spec::Output::projected)
    return static_cast<std::uint64_t>(std::abs(own)) << plan.weight_up;
  const std::int64_t added = plan.hold > 0 ? 0 : bias;
  return (std::uint64_t{sum} << plan.weight_up) +
         (static_cast<std::uint64_t>(std::abs(added)) << plan.bias_up);
}

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
  const double r = static_cast<double>(reciprocal(norm, plan.reciprocal_bits));
  return {bits_of(std::ldexp(r, -places_behind(plan, norm))), 0};
}

// s without a divisor is at its limit at once, which no such product says.
std::int32_t brief_inverse(const NeuronPlan& plan, std::uint64_t norm) {
  if (norm == 0) return 0;
  const std::int64_t r = reciprocal(norm, plan.reciprocal_bits);
  const int up = 32 - places_behind(plan, norm);
  const bool fits = up >= 0 ? bit_length(static_cast<std::uint64_t>(r)) + up <= 31
                            : up > -32 && r % (std::int64_t{1} << -up) == 0;
  return static_cast<std::int32_t>(!fits ? -1 : up >= 0 ? r << up : r >> -up);
}

} // namespace hopmesh::engine
