#include "sim/networks/solvers/spectrum.h"

#include <cmath>

namespace hopmesh::solvers {

double largest_curvature(const Problem& problem) {
  constexpr int iterations = 200;
  constexpr double enough = 1e-5, margin = 1.02;
  Vector x(problem.I.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = 1 + std::fmod(0.618034 * static_cast<double>(i), 1); // no symmetry
  double value = 0;
  for (int k = 0; k < iterations; ++k) {
    x = -(problem.W * x.normalized());
    const double now = x.norm();
    if (now == 0 || std::abs(now - value) <= enough * now) return margin * now;
    value = now;
  }
  return margin * value;
}

} // namespace hopmesh::solvers
