// Where the points of all signals lie, and by how many places each step moves them: worked out once for an
// array, and read by every neuron of it (docs/hardware/datapath.md).
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::systemc {

struct Datapath {
  /// `accumulator_format`: of s as built; sources give `per_source` wires each.
  Datapath(const spec::ArraySpec& array, const spec::NumberFormat& accumulator_format,
           std::size_t per_source);

  const std::size_t lanes, per_source;
  const spec::NumberFormat accumulator, drive, state, link;
  const bool exact;  ///< the accumulator has room for every place of every sum
  const bool binary; ///< u is the sign of s, and nothing is normalised
  const spec::Normaliser normaliser;
  const int reciprocal_bits;

  const int product_up, sum_up;           ///< bring products and s to their common last place
  const int bias_places;                  ///< by which the bias is finer than s (below zero: coarser)
  const int weight_norm_up, bias_norm_up; ///< bring |weight| and |bias| to the last place of N
  const int ratio_up;                     ///< s * 2^ratio_up / N counts in the drive's last place
  const int scaled_places;                ///< by which s is finer than the drive (prescaled rows)
  const bool narrow;                      ///< s * 2^ratio_up fits 63 bits: a 64-bit division will do
};

} // namespace hopmesh::systemc
