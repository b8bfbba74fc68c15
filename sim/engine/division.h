// Quotients of integers, rounded as rounding.h says.
#pragma once

#include "sim/engine/rounding.h"

namespace hopmesh::engine {

inline int bit_length(std::uint64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(x);
}

/// floor(x / d), d > 0.
template <typename Int> Int floor_quotient(Int x, Int d) {
  const Int toward_zero = x / d;
  return toward_zero - (toward_zero * d > x);
}

/// x / d rounded, d > 0; 2 |x| + 2 d must fit. Computed as 2 x / 2 d, so that half a unit is the integer d.
template <typename Int> [[gnu::noinline]] Int round_quotient(Int x, Int d, const RoundingRule& rule) {
  if (rule.unit_if_negative) return x / d; // toward zero
  Int y = 2 * x + rule.add(d);
  if (rule.ones_if_negative) y += -static_cast<Int>(x < 0) & rule.add_if_negative(d);
  const Int quotient = floor_quotient<Int>(y, 2 * d);
  if (rule.ones_if_odd == 0) return quotient;
  return quotient +
         (quotient & (y + rule.ones_if_odd ==
                      (quotient + 1) * 2 * d)); // the floor of x / d is odd, and one more reaches the next
}

/// floor(2^(b + bits - 2) / N), b the bit length of N > 0: a number of `bits` bits.
inline std::int64_t reciprocal(std::uint64_t norm, int bits) {
  const int exponent = bit_length(norm) + bits - 2;
  return exponent < 63 ? static_cast<std::int64_t>((std::uint64_t{1} << exponent) / norm)
                       : static_cast<std::int64_t>((Int128{1} << exponent) / static_cast<Int128>(norm));
}

} // namespace hopmesh::engine
