// The least of E = -1/2 V'WV - I'V, found without a neuron: what answers of the problem set are held to.
#pragma once

#include "sim/files/matrix_market.h"

namespace hopmesh::tests {

struct BoxAnswer {
  std::vector<double> V;
  double energy = 0;
  double kkt = 0;      ///< largest step along -dE/dV that the box leaves, over the largest |W| or |I|
  bool solved = false; ///< kkt is at most the tolerance
};

/// On the box [-1, 1]: one output after the other goes to the least along its axis, in long double, until the
/// KKT conditions hold. The global answer where W is negative semi-definite, else the one it falls into.
BoxAnswer least_on_box(const files::SparseMatrix& W, const std::vector<double>& bias,
                       const std::vector<double>& start, double tolerance = 1e-13,
                       std::size_t most_sweeps = 200'000);

/// At the corners of the box, by trying them all: at most 30 neurons.
double least_at_corners(const files::SparseMatrix& W, const std::vector<double>& bias);

} // namespace hopmesh::tests
