// Where the binary points of an array's signals lie, and by how many places each step of a neuron moves them
// (docs/hardware/datapath.md). Statements about formats: nobody's codes are computed here.
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::spec {

/// Places between two points; `up` multiplies a code by 2^places, `down` divides it. Below zero, the other
/// way round.
struct Points {
  int product_up, sum_up; ///< from products, and from s, to the finer point of product and bias
  int bias_down;          ///< from the bias to s
  int weight_up, bias_up; ///< from |weight| and |bias| to the point of N, the finer of theirs
  int ratio_up;           ///< s * 2^ratio_up / N counts in the drive's last place
  int scaled_down;        ///< from s to the drive, where rows are prescaled
  int link_down;          ///< from the state to the link
  int step_down;          ///< from the drive to the state, where u itself is the step
};

/// What divides a product with omega, which is in sixteenths; and one with m, which has the places of
/// momentum_format.
inline constexpr int relaxation_down = 4;
inline constexpr int momentum_down = momentum_format.fraction_bits();

/// `built`: with the accumulator as built (built_formats).
inline Points points_of(const Formats& built) {
  const int weight = built.weight.fraction_bits(), bias = built.bias.fraction_bits();
  const int sum = built.accumulator.fraction_bits(), drive = built.drive.fraction_bits();
  const int link = built.link.fraction_bits(), product = weight + link;
  const int finest = std::max(product, bias), norm = std::max(weight, bias);
  Points p{};
  p.product_up = finest - product;
  p.sum_up = finest - sum;
  p.bias_down = bias - sum;
  p.weight_up = norm - weight;
  p.bias_up = norm - bias;
  p.ratio_up = drive + norm - sum;
  p.scaled_down = sum - drive;
  p.link_down = built.state.fraction_bits() - link;
  p.step_down = drive - built.state.fraction_bits();
  return p;
}

} // namespace hopmesh::spec
