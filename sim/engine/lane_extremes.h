// Extremes of fired neurons, lane by lane, as the kernels keep them in their registers. The kernels include
// this, so it includes nothing but integers.
#pragma once

#include <cstdint>

namespace hopmesh::engine {

/// Firing widens them. |Delta V| is unsigned: it may be 2^31.
struct alignas(64) LaneExtremes {
  std::uint32_t largest_change[16] = {};
  std::int64_t least_sum[8] = {}, largest_sum[8] = {}, least_drive[8] = {}, largest_drive[8] = {};
  std::int64_t largest_moving[8] = {}; ///< |s| of neurons that may still move, where it is asked for
  std::int64_t along[8] = {};          ///< sums of sign(s) Delta V, of momentum
};

} // namespace hopmesh::engine
