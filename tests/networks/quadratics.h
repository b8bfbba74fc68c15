// Small boxed quadratics for the tests of solvers, and slow, obvious answers to them.
#pragma once

#include "sim/networks/solvers/network_solver.h"
#include "sim/networks/solvers/solver_runs.h"
#include "tests/reference/random_inputs.h"

#include <Eigen/Dense>
#include <cmath>

namespace hopmesh::tests {

/// Its neurons stand for two components in turn.
inline solvers::Problem problem_of(const Eigen::MatrixXd& W, const solvers::Vector& I,
                                   const solvers::Vector& start) {
  const solvers::Weights sparse = W.sparseView();
  std::vector<std::uint32_t> component;
  for (Eigen::Index i = 0; i < I.size(); ++i) component.push_back(i % 2);
  return {sparse, I, start, coloured(sparse), component};
}

/// A problem of random signs and curvatures, and a start anywhere.
inline solvers::Problem random_problem(Random& random, Eigen::Index n) {
  const auto network = random_network(random, n);
  return solvers::reached(problem_of(network.W, network.I, random_point(random, n)));
}

/// H = -W positive definite; I pulls `pull` times as hard as a curvature of 1 holds.
inline solvers::Problem random_convex(Random& random, Eigen::Index n, double pull) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  solvers::Vector I(n), start(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, i) = random.between(0.5, 1.5);
    for (Eigen::Index j = 0; j < n; ++j)
      if (random.chance(2.0 / static_cast<double>(n))) A(i, j) += random.between(-1, 1);
    I[i] = pull * random.between(-1, 1);
    start[i] = random.between(-1, 1);
  }
  const Eigen::MatrixXd W = -(A.transpose() * A + 0.05 * Eigen::MatrixXd::Identity(n, n));
  return problem_of(W, I, start);
}

/// -1/2 V'WV - I'V.
inline double energy(const solvers::Problem& p, const solvers::Vector& V) {
  const Eigen::MatrixXd W = p.W;
  return -0.5 * V.dot(W * V) - p.I.dot(V);
}

/// The least energy on the box by trying every face of it: each output free, at 1, or at -1.
inline solvers::Vector answer_by_faces(const solvers::Problem& p) {
  const Eigen::MatrixXd W = p.W;
  const Eigen::Index n = p.I.size();
  solvers::Vector best = p.start;
  for (int face = 0; face < std::pow(3, n); ++face) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
    solvers::Vector b(n);
    int rest = face;
    for (Eigen::Index i = 0; i < n; ++i, rest /= 3) {
      b[i] = rest % 3 == 1 ? 1 : -1;
      if (rest % 3 == 0) A.row(i) = -W.row(i), b[i] = p.I[i];
    }
    const solvers::Vector V = A.fullPivLu().solve(b);
    if (V.allFinite() && V.cwiseAbs().maxCoeff() <= 1 + 1e-12 && energy(p, V) < energy(p, best)) best = V;
  }
  return best;
}

/// After so many sweeps.
inline solvers::Vector after(const std::string& name, const solvers::Problem& problem, int sweeps,
                             bool convex = true) {
  const auto solver = solvers::make_solver(name, problem, convex);
  for (int k = 0; k < sweeps; ++k) solver->sweep();
  return solver->V();
}

inline const std::atomic<bool> never{false};

} // namespace hopmesh::tests
