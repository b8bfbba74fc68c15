// Codes that share the words of the bus: code k stands in word k / n, from the low end on.
#pragma once

#include "sim/engine/rounding.h"

namespace hopmesh::engine {

/// Takes `count` words of `n` codes each apart, sign extended; what stands behind the last code of a window
/// is the caller's to leave out.
inline void take_apart(const std::uint32_t* words, std::size_t count, int n, std::uint32_t* codes) {
  const int bits = 32 / n;
  for (std::size_t k = 0; k < count; ++k)
    for (int at = 0; at < n; ++at)
      *codes++ = static_cast<std::uint32_t>(static_cast<std::int32_t>(words[k] << (32 - bits * (at + 1))) >>
                                            (32 - bits));
}

/// The other way, from `count` codes; the last word is filled up with zeros.
inline void put_together(const std::uint32_t* codes, std::size_t count, int n, std::uint32_t* words) {
  const int bits = 32 / n;
  for (std::size_t k = 0; k < count; k += static_cast<std::size_t>(n)) {
    std::uint32_t word = 0;
    for (std::size_t at = 0; at < static_cast<std::size_t>(n) && k + at < count; ++at)
      word |= (codes[k + at] << (32 - bits)) >> (32 - bits) << (bits * static_cast<int>(at));
    *words++ = word;
  }
}

} // namespace hopmesh::engine
