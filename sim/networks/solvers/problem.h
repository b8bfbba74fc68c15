// A step's question to the network, min E(V) = -1/2 V'WV - I'V with every |V| <= 1, as all solvers here
// take it.
#pragma once

#include <Eigen/Sparse>
#include <cstdint>
#include <vector>

namespace hopmesh::solvers {

using Vector = Eigen::VectorXd;
using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
/// Phases of neurons that fire together, all from the outputs before the phase.
using Order = std::vector<std::vector<std::uint32_t>>;

struct Problem {
  Weights W; ///< symmetric
  Vector I, start;
  Order colours;                        ///< every neuron once; those of a phase share no weight
  std::vector<std::uint32_t> component; ///< of its node, that a neuron stands for
};

/// Neurons that something reaches: not those of pinned nodes.
std::vector<Eigen::Index> reached_neurons(const Problem& problem);
/// The problem of those neurons alone, in their order, the start within the box.
Problem reached(const Problem& problem);

/// s = WV + I: the way down.
Vector inputs(const Problem& problem, const Vector& V);
/// The input of a single neuron.
double input(const Problem& problem, const Vector& V, Eigen::Index neuron);
/// N_i = sum_j |W_ij| + |I_i|.
Vector normalisers(const Problem& problem);
/// E(V + d) - E(V) from s = inputs(V), without the rounding of two large energies.
double rise(const Problem& problem, const Vector& s, const Vector& d);
/// How far a step of s_i / N_i can move an output within the box: 0 exactly where the KKT conditions hold.
double kkt_violation(const Problem& problem, const Vector& V);

inline Vector into_box(const Vector& V) {
  return V.cwiseMax(-1).cwiseMin(1);
}

} // namespace hopmesh::solvers
