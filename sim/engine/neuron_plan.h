// What of an array's description its neurons need, and where the points of its numbers lie.
#pragma once

#include "rtl_model/spec/points.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::engine {

struct NeuronPlan : spec::Points {
  NeuronPlan(const spec::ArraySpec& array, const spec::Topology& topology);
  /// Of an array whose longest row has so many taps.
  NeuronPlan(const spec::ArraySpec& array, std::size_t taps, int neurons_in_cell);

  spec::Formats formats; ///< with the accumulator as built
  spec::Schedule schedule;
  spec::Normaliser normaliser;
  int lanes, reciprocal_bits, neurons_per_cell;
  bool exact;  ///< the accumulator loses nothing
  bool binary; ///< u is the sign of s, and nothing is normalised
  std::size_t most_taps;

  int norm_bits;         ///< bits of the largest N that codes of these formats can make
  int multiplier_places; ///< of s times the reciprocal of such an N, behind the drive's last place
  std::int64_t one_state, one_drive, one_link;
};

} // namespace hopmesh::engine
