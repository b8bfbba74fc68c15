// A sparse factorisation of -W on some of the outputs, all of them or those between the bounds.
#pragma once

#include "sim/networks/solvers/problem.h"

#include <Eigen/SparseCholesky>

namespace hopmesh::solvers {

class Factor {
 public:
  /// Of -W + shift on the outputs named.
  Factor(const Problem& problem, const std::vector<Eigen::Index>& outputs, double shift);

  /// Whether it is positive definite; else solve() is good for nothing.
  bool positive() const { return positive_; }
  /// x with (-W + shift) x = b on the outputs named; [outputs] in, [outputs] out.
  Vector solve(const Vector& b) const { return solver_.solve(b); }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  bool positive_ = true;
};

std::vector<Eigen::Index> all_outputs(const Problem& problem);
/// Whether -W is positive definite.
bool is_convex(const Problem& problem);

} // namespace hopmesh::solvers
