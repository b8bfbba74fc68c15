// Codes that leave their format: SystemC's four overflow modes on integers (docs/hardware/datapath.md, Q).
#pragma once

#include "rtl_model/spec/number_format.h"

namespace hopmesh::engine {

/// What overflow does, as numbers that a loop can use: a code in [low, high] stays as it is; any other
/// becomes the low bits of a word (wrap), zero, or the nearer end.
struct Limit {
  explicit Limit(const spec::NumberFormat& f)
      : low(f.min_raw()), high(f.max_raw()), unused(f.overflow == spec::Overflow::wrap ? 64 - f.width : 0),
        zero(f.overflow == spec::Overflow::sat_zero) {}
  std::int64_t low, high;
  int unused; ///< bits of 64 above the word that wraps; 0: does not wrap
  bool zero;
};

template <bool wrap, bool zero, typename Int>
[[gnu::always_inline]] inline std::int64_t limited(Int x, const Limit& f) {
  if (wrap) return static_cast<std::int64_t>(static_cast<std::uint64_t>(x) << f.unused) >> f.unused;
  if (zero) return f.low <= x && x <= f.high ? static_cast<std::int64_t>(x) : 0;
  return x < f.low ? f.low : x > f.high ? f.high : static_cast<std::int64_t>(x);
}

/// A code brought into the format's range.
template <typename Int> std::int64_t limited(Int code, const Limit& f) {
  if (f.unused > 0) return limited<true, false>(code, f);
  return f.zero ? limited<false, true>(code, f) : limited<false, false>(code, f);
}

/// The low bits that a memory of this format keeps of a bus word, sign extended.
inline std::int32_t kept_bits(std::uint32_t word, const spec::NumberFormat& f) {
  return static_cast<std::int32_t>(word << (32 - f.width)) >> (32 - f.width);
}

} // namespace hopmesh::engine
