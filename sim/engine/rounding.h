// The engine's door for losing bits: SystemC's rounding and overflow modes on integers
// (docs/hardware/datapath.md, Q). Each mode is a floor after the right thing was added; nothing here is
// shared with another level.
#pragma once

#include "rtl_model/spec/number_format.h"

namespace hopmesh::engine {

__extension__ typedef __int128 Int128;

template <typename Int> Int shifted_up(Int x, int places) {
  return x * (Int{1} << places);
}

/// x * 2^-places, rounded; exact for places <= 0.
template <typename Int> Int round_shift(Int x, int places, spec::Rounding mode) {
  if (places <= 0) return shifted_up(x, -places);
  const Int unit = Int{1} << places, half = unit >> 1;
  switch (mode) {
  case spec::Rounding::trn:
    return x >> places;
  case spec::Rounding::trn_zero:
    return (x + (x < 0 ? unit - 1 : 0)) >> places;
  case spec::Rounding::rnd:
    return (x + half) >> places;
  case spec::Rounding::rnd_min_inf:
    return (x + half - 1) >> places;
  case spec::Rounding::rnd_zero:
    return (x + half - (x > 0)) >> places;
  case spec::Rounding::rnd_inf:
    return (x + half - (x < 0)) >> places;
  case spec::Rounding::rnd_conv:
    return (x + half - 1 + ((x >> places) & 1)) >> places;
  }
  return x;
}

/// floor(x / d), d > 0.
template <typename Int> Int floor_quotient(Int x, Int d) {
  const Int q = x / d;
  return q - (q * d > x);
}

/// x / d rounded, d > 0; 2 |x| + d must fit.
template <typename Int> Int round_quotient(Int x, Int d, spec::Rounding mode) {
  const bool negative = x < 0;
  const Int size = negative ? -x : x;
  Int q = 0;
  switch (mode) {
  case spec::Rounding::trn:
    return floor_quotient(x, d);
  case spec::Rounding::trn_zero:
    q = size / d;
    break;
  case spec::Rounding::rnd:
    return floor_quotient<Int>(2 * x + d, 2 * d);
  case spec::Rounding::rnd_min_inf:
    return -floor_quotient<Int>(d - 2 * x, 2 * d);
  case spec::Rounding::rnd_zero:
    q = -floor_quotient<Int>(d - 2 * size, 2 * d);
    break;
  case spec::Rounding::rnd_inf:
    q = (2 * size + d) / (2 * d);
    break;
  case spec::Rounding::rnd_conv:
    q = (2 * size + d) / (2 * d);
    q -= (q & 1) && q * 2 * d == 2 * size + d; // a tie went up to an odd number
    break;
  }
  return negative ? -q : q;
}

/// A code brought into the format's range.
template <typename Int> std::int64_t limit_to_format(Int code, const spec::NumberFormat& f) {
  const Int high = f.max_raw(), low = f.min_raw();
  if (low <= code && code <= high) return static_cast<std::int64_t>(code);
  if (f.overflow == spec::Overflow::sat_zero) return 0;
  if (f.overflow != spec::Overflow::wrap) return static_cast<std::int64_t>(code > high ? high : low);
  const std::uint64_t sign = std::uint64_t{1} << (f.width - 1), kept = std::uint64_t(code) & (2 * sign - 1);
  return static_cast<std::int64_t>(kept ^ sign) - static_cast<std::int64_t>(sign);
}

/// The low bits that a memory of this format keeps of a bus word, sign extended.
inline std::int32_t kept_bits(std::uint32_t word, const spec::NumberFormat& f) {
  const std::uint32_t sign = std::uint32_t{1} << (f.width - 1), mask = 2 * (sign - 1) + 1;
  return static_cast<std::int32_t>(((word & mask) ^ sign) - sign);
}

} // namespace hopmesh::engine
