// What kernels multiply s of a row with, made of what divides it.
#pragma once

#include "sim/engine/neuron_plan.h"

namespace hopmesh::engine {

struct RowInverse {
  std::int64_t multiplier = 0; ///< an integer, or the bits of a double
  std::int64_t most_sum = 0;   ///< s is held within it; of held inverses
};

/// What divides s of a row, whose |w| add up to `sum`; `own`: its weight from itself, of projected outputs.
std::uint64_t row_divisor(const NeuronPlan& plan, std::int32_t own, std::uint32_t sum, std::int32_t bias);

/// Of modified outputs. An empty row has none, and u = 0.
RowInverse modified_inverse(const NeuronPlan& plan, std::uint64_t norm);
/// Of projected and momentum. Where s has no divisor, it is at its limit as soon as it is not zero.
RowInverse held_inverse(const NeuronPlan& plan, std::uint64_t norm);
/// Of slim kernels: always a double. Behind a divider, s must have a divisor.
RowInverse slim_inverse(const NeuronPlan& plan, std::uint64_t norm);
/// Of kernels that take u of s times it, 32 places lower, where a reciprocal multiplies; -1: it needs more
/// bits.
std::int32_t brief_inverse(const NeuronPlan& plan, std::uint64_t norm);

} // namespace hopmesh::engine
