// How wide the numbers of a neuron are, and how many there are of each: what a file of firings is laid out
// by.
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::cosim {

struct NeuronShape {
  /// Rows of at most `most_taps` inputs. The array must have passed spec::validate for them.
  NeuronShape(const spec::ArraySpec& described, std::size_t most_taps);

  spec::ArraySpec array;
  std::size_t taps, beats;
  spec::Formats formats; ///< with the accumulator as built
  int norm_bits;         ///< of the largest N that codes of these formats can make
  int drive_bits;        ///< of u: one more than the format has where u goes up to 2
  int product_bits;      ///< of R u, or of m dV, sign included

  std::size_t beats_of(std::size_t row) const {
    const auto lanes = static_cast<std::size_t>(array.lanes);
    return (row + lanes - 1) / lanes;
  }
};

} // namespace hopmesh::cosim
