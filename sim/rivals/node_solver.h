// A constant matrix over free nodes, the same for x, y and z, factorised once and solved for the three
// together.
#pragma once

#include "sim/rivals/physics.h"

#include <Eigen/SparseCore>

namespace hopmesh::rivals {

class NodeSolver {
 public:
  /// inertia + sum of k over each spring's Laplacian; pinned nodes left out.
  NodeSolver(const Physics& physics, double inertia);

  /// Overwrites the moving coordinates of a [3 * nodes] vector with the solution; the others become 0.
  void solve(Vector& all);

 private:
  using Three = Eigen::Array4d; ///< x, y, z and an idle lane: one instruction does all

  void eliminate();

  const Physics& physics_;
  std::vector<Eigen::Index> node_; ///< [unknowns] in the order of elimination
  Eigen::SparseMatrix<double> factor_;
  Eigen::VectorXd inverse_pivot_;
  std::vector<Three, Eigen::aligned_allocator<Three>> value_;
};

} // namespace hopmesh::rivals
