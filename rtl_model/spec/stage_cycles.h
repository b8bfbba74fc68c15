// Cycles of the parts of a neuron, from the first tap to the new V (docs/hardware/cycles.md).
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::spec {

inline std::uint64_t accumulate_cycles(const ArraySpec& a, std::size_t taps) {
  return (taps + a.lanes - 1) / a.lanes;
}

/// Binary: the sign of s (1). Prescaled: round (1). Reciprocal: multiply, shift and round (2). Divider: one
/// quotient bit a cycle (fraction bits, the unit, and where u goes up to 2 a bit more), then round.
inline std::uint64_t normalise_cycles(const ArraySpec& a) {
  if (!sums_norm(a)) return 1;
  if (a.normaliser == Normaliser::reciprocal) return 2;
  return a.formats.drive.fraction_bits() + (a.output == Output::projected ? 3 : 2);
}

/// Is V written with Delta V? Behind a sign or a step that is added as it is, nothing is left to multiply.
inline bool changes_at_once(const ArraySpec& a) {
  return a.output == Output::binary || a.output == Output::projected;
}

/// R u, or momentum's V' and its way from V (1; none where V changes at once); new V, and Y, onto state and
/// link (1).
inline std::uint64_t output_cycles(const ArraySpec& a) {
  return changes_at_once(a) ? 1 : 2;
}

/// Registers of a pipeline that lie in front of u; the others lie between u and Delta V. The page tells the
/// order in which they find their places.
inline std::uint64_t registers_before_u(const ArraySpec& a) {
  if (a.output == Output::binary) return 0;
  if (a.output == Output::projected) return static_cast<std::uint64_t>(a.pipeline);
  if (a.normaliser == Normaliser::prescaled) return a.pipeline >= 2;
  return (a.pipeline >= 1) + (a.pipeline >= 3);
}

// From the last cycle of the sum on: u is written in the cycle of this number, Delta V, and V.
inline std::uint64_t drive_cycles(const ArraySpec& a) {
  return normalise_cycles(a) + registers_before_u(a);
}
inline std::uint64_t stage_cycles(const ArraySpec& a) {
  return normalise_cycles(a) + output_cycles(a) + static_cast<std::uint64_t>(a.pipeline);
}
inline std::uint64_t change_cycles(const ArraySpec& a) {
  return changes_at_once(a) ? stage_cycles(a) : stage_cycles(a) - 1;
}

/// From the last cycle of N on: 1 / N, and writing it.
inline std::uint64_t reciprocal_cycles(const ArraySpec& a) {
  return has_reciprocal(a) ? static_cast<std::uint64_t>(a.reciprocal_bits) + 1 : 0;
}

} // namespace hopmesh::spec
