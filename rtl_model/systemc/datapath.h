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
  const bool binary;           ///< u is the sign of s, and nothing is normalised
  const spec::Normaliser normaliser;
  const int reciprocal_bits;
  const bool narrow; ///< s * 2^ratio_up fits 63 bits: a 64-bit division will do
};

} // namespace hopmesh::systemc
