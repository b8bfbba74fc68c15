// Sums over a neuron's row, in one order, so that |s| <= N survives rounding.
#pragma once

#include "sim/reference/relaxation.h"

#include <cmath>

namespace hopmesh::reference {

/// Input accumulator: s = sum_j W_ij V_j + I_i, the node itself among the j.
inline double input_sum(const Network& network, const Vector& V, Eigen::Index neuron) {
  const auto* start = network.W.outerIndexPtr();
  const auto* column = network.W.innerIndexPtr();
  const double* weight = network.W.valuePtr();
  double s = network.I[neuron];
  for (auto k = start[neuron]; k < start[neuron + 1]; ++k) s += weight[k] * V[column[k]];
  return s;
}

inline void add_row_sums(const Network& network, Vector& N) {
  for (Eigen::Index neuron = 0; neuron < N.size(); ++neuron)
    for (Matrix::InnerIterator w(network.W, neuron); w; ++w) N[neuron] += std::abs(w.value());
}

/// N_i = sum_j |W_ij| + |I_i| (paper eq. 9, diagonal included): what keeps u within [-1, 1]. In the order of
/// input_sum.
inline Vector normalisers(const Network& network) {
  Vector N = network.I.cwiseAbs();
  add_row_sums(network, N);
  return N;
}

/// sum_j |W_ij|: diag of it + W is diagonally dominant, which lets all neurons move at once.
inline Vector row_sums(const Network& network) {
  Vector N = Vector::Zero(network.I.size());
  add_row_sums(network, N);
  return N;
}

} // namespace hopmesh::reference
