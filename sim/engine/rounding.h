// The engine's one door for rounding: SystemC's seven modes on integers (docs/hardware/datapath.md, Q). Every
// mode is a floor after the right thing was added, whether bits are shifted out (here) or a quotient is cut
// (division.h). The kernels read this too, so it includes nothing but integers; kernel_body.h says why.
#pragma once

#include <cstdint>

namespace hopmesh::spec {
enum class Rounding : std::uint8_t;
}

namespace hopmesh::engine {

__extension__ typedef __int128 Int128;

/// What a mode adds to x before the floor, in parts of a unit of the result and in ones of the last place of
/// x.
struct RoundingRule {
  bool half, unit_if_negative; ///< half a unit always; a unit more where x < 0
  std::int64_t ones, ones_if_negative;
  std::int64_t ones_if_odd; ///< where the floor of x is odd

  // In ones, where half a unit of the result is `half_unit` of them.
  template <typename Int> [[gnu::always_inline]] Int add(Int half_unit) const {
    return (half ? half_unit : 0) + ones;
  }
  template <typename Int> [[gnu::always_inline]] Int add_if_negative(Int half_unit) const {
    return (unit_if_negative ? 2 * half_unit : 0) + ones_if_negative;
  }
};
RoundingRule rounding_rule(spec::Rounding mode);

template <typename Int> Int shifted_up(Int x, int places) {
  return x * (Int{1} << places);
}

/// A rule for one number of places: x * 2^-places rounded.
template <typename Int> struct BasicShiftRounding {
  Int add = 0, add_if_negative = 0, add_if_odd = 0;
  int places = 0; ///< below zero: x moves up, and loses nothing
  /// Is `add` all that is added?
  bool plain() const { return add_if_negative == 0 && add_if_odd == 0; }
};
using ShiftRounding = BasicShiftRounding<std::int64_t>; ///< where all fits 63 bits
using WideShiftRounding = BasicShiftRounding<Int128>;

template <typename Int = std::int64_t>
BasicShiftRounding<Int> shift_rounding(int places, const RoundingRule& rule) {
  if (places <= 0) return {0, 0, 0, places};
  const Int half_unit = Int{1} << (places - 1);
  return {rule.add(half_unit), rule.add_if_negative(half_unit), rule.ones_if_odd, places};
}
template <typename Int = std::int64_t>
BasicShiftRounding<Int> shift_rounding(int places, spec::Rounding mode) {
  return shift_rounding<Int>(places, rounding_rule(mode));
}

/// x * 2^-places rounded, places >= 0. `X` is std::int64_t or a vector of it. The function is forced into its
/// caller: left outside, it would be compiled for the plainest processor only.
template <typename X> [[gnu::always_inline]] inline X rounded(X x, const ShiftRounding& r) {
  return (x + r.add + ((x >> 63) & r.add_if_negative) + ((x >> r.places) & r.add_if_odd)) >> r.places;
}
/// x * 2^-places rounded, for any number of places. Branches, since in 128 bits every addition costs.
inline Int128 rounded(Int128 x, const WideShiftRounding& r) {
  if (r.places <= 0) return shifted_up(x, -r.places);
  Int128 sum = x + r.add;
  if (r.add_if_negative) sum += (x >> 127) & r.add_if_negative;
  if (r.add_if_odd) sum += (x >> r.places) & 1;
  return sum >> r.places;
}

} // namespace hopmesh::engine
