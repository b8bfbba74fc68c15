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
  bool exact; ///< the accumulator loses nothing
  spec::Output output;
  bool binary; ///< u is the sign of s, and nothing is normalised
  /// s is multiplied by gain * 2^-gain_places before it is divided: omega, or one.
  int gain, gain_places;
  /// Projected and momentum: u is limited before it is rounded, and no stage pulls V to a bound. From so many
  /// times the divisor on, s makes a u at its limit whatever is cut off on the way; else 0.
  int hold;
  std::size_t most_taps;

  int norm_bits;         ///< bits of the largest divisor, N or |w_ii|, that codes of these formats can make
  int norm_up;           ///< from the divisor's last place to that of s
  int multiplier_places; ///< of s times gain and reciprocal of such an N, behind the drive's last place
  std::int64_t one_state, one_drive, one_link;
  std::int64_t most_drive; ///< the limit of |u|
  /// A link shows 1 from the first code of the state on, and -1 up to the second: s holds a neuron there.
  std::int64_t least_at_one, most_at_minus_one;
};

} // namespace hopmesh::engine
