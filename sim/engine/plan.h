// Where the points of an array's numbers lie, and by how many places each step of a neuron moves them.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::engine {

struct Plan {
  Plan(const spec::ArraySpec& array, const spec::Topology& topology);

  spec::Formats formats; ///< with the accumulator as built
  spec::Schedule schedule;
  spec::Normaliser normaliser;
  int lanes, reciprocal_bits, neurons_per_cell;
  bool exact;  ///< the accumulator loses nothing
  bool binary; ///< u is the sign of s, and nothing is normalised
  std::size_t most_taps;

  // A row's sum is formed in the finest last place of products and bias, then written into s.
  int product_up, sum_up; ///< of a product, and of s, to that last place
  int bias_down;          ///< from the bias to s; below zero: up
  int weight_up, bias_up; ///< from |w| and |I| to N
  int ratio_up;           ///< s 2^ratio_up / N counts in the drive's last place
  int scaled_down;        ///< prescaled: from s to the drive; below zero: up
  int link_down;          ///< from the state to the link

  int norm_bits;         ///< bits of the largest N that codes of these formats can make
  int multiplier_places; ///< of s times the reciprocal of such an N, behind the drive's last place

  std::int64_t one_state, one_drive, one_link;
};

} // namespace hopmesh::engine
