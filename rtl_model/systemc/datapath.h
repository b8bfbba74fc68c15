// What every neuron of an array knows of it: formats as built, and where their points lie.
#pragma once

#include "rtl_model/spec/points.h"

namespace hopmesh::systemc {

struct Datapath : spec::Points {
  /// For rows of at most `taps` inputs, from sources of `per_source` wires each.
  Datapath(const spec::ArraySpec& array, std::size_t taps, std::size_t per_source);

  const std::size_t lanes, per_source;
  const spec::Formats formats; ///< as built
  const bool exact;            ///< the accumulator has room for every place of every sum
  const spec::Output output;
  const bool binary; ///< u is the sign of s, and nothing is normalised
  const spec::Normaliser normaliser;
  const int reciprocal_bits;
  /// What multiplies the quotient of s: factor * 2^-factor_down, which is omega with `projected`, else 1.
  const std::int64_t factor;
  const int factor_down;
  const int quotient_up; ///< factor * s * 2^quotient_up over what divides s counts in the drive's last place
  const bool narrow;     ///< factor * s * 2^quotient_up fits 63 bits: a 64-bit division will do
};

} // namespace hopmesh::systemc
