// A sparse factorisation of -W on some of a network's outputs: all that it has, or those between the bounds.
#pragma once

#include "sim/reference/relaxation.h"

#include <Eigen/SparseCholesky>

namespace hopmesh::levels {

class DefinitePart {
 public:
  /// Of -W + shift on the outputs named; W symmetric, of its lower half at least.
  DefinitePart(const reference::Matrix& W, const std::vector<Eigen::Index>& outputs, double shift);

  /// Whether it is positive definite; else solve() is good for nothing.
  bool positive() const { return positive_; }
  /// x with (-W + shift) x = b on the outputs named; [outputs] in, [outputs] out.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return solver_.solve(b); }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  bool positive_ = true;
};

} // namespace hopmesh::levels
