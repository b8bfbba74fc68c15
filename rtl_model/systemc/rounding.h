// The one door through which the SystemC model loses bits: rounding and overflow on integers
// (docs/hardware/datapath.md, Q).
#pragma once

#include "rtl_model/spec/number_format.h"

namespace hopmesh::systemc {

__extension__ typedef __int128 Wide; ///< holds every intermediate of the datapath exactly

/// The integer nearest to x / d (d > 0) in the sense of the rounding mode; exact, any sign of x.
template <typename Integer> Integer round_quotient(Integer x, Integer d, spec::Rounding mode) {
  Integer floor = x / d, rest = x % d;
  if (rest < 0) floor -= 1, rest += d;
  if (rest == 0) return floor;
  const bool negative = x < 0;
  const Integer beyond_half = rest - (d - rest); // > 0: nearer to floor + 1; 0: a tie
  switch (mode) {
  case spec::Rounding::trn:
    return floor;
  case spec::Rounding::trn_zero:
    return floor + negative;
  case spec::Rounding::rnd:
    return floor + (beyond_half >= 0);
  case spec::Rounding::rnd_zero:
    return floor + (beyond_half > 0 || (beyond_half == 0 && negative));
  case spec::Rounding::rnd_min_inf:
    return floor + (beyond_half > 0);
  case spec::Rounding::rnd_inf:
    return floor + (beyond_half > 0 || (beyond_half == 0 && !negative));
  case spec::Rounding::rnd_conv:
    return floor + (beyond_half > 0 || (beyond_half == 0 && (floor & 1)));
  }
  return floor;
}

/// x * 2^-places, rounded; places may be negative (then nothing is lost).
template <typename Integer> Integer round_places(Integer x, int places, spec::Rounding mode) {
  if (places <= 0) return x * (Integer{1} << -places);
  const Integer floor = x >> places, unit = Integer{1} << places;
  if (mode == spec::Rounding::trn) return floor;
  if (mode == spec::Rounding::rnd) return (x + (unit >> 1)) >> places;
  return round_quotient(x, unit, mode);
}

/// A code brought into the format's range by its overflow mode.
template <typename Integer> std::int64_t into_range(Integer code, const spec::NumberFormat& f) {
  if (code >= f.min_raw() && code <= f.max_raw()) return static_cast<std::int64_t>(code);
  switch (f.overflow) {
  case spec::Overflow::sat_zero:
    return 0;
  case spec::Overflow::wrap: {
    const int unused = 64 - f.width;
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(code) << unused) >> unused;
  }
  default:
    return code < 0 ? f.min_raw() : f.max_raw();
  }
}

} // namespace hopmesh::systemc
