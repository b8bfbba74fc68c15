// The second derivative of the spring energy as a sparse matrix over what is free to move, its pattern found
// once and its values written in place.
#pragma once

#include "sim/rivals/physics.h"

#include <Eigen/SparseCore>

namespace hopmesh::rivals {

using Sparse = Eigen::SparseMatrix<double>;

class Stiffness {
 public:
  explicit Stiffness(const Physics& physics);

  /// Sum of S_e (docs/method/theory.md, section 2, without h^2) plus `diagonal` on every coordinate.
  /// `projected`: L/l at most 1, which leaves every spring, and so the whole, without negative directions.
  void assemble(In position, double diagonal, bool projected);
  const Sparse& lower() const { return matrix_; } ///< the lower triangle of a symmetric matrix

  /// Free coordinates of a [3 * nodes] vector, node by node, and back; the others stay as they are.
  void gather(const Vector& all, Vector& free) const;
  void scatter(const Vector& free, Vector& all) const;
  Eigen::Index freedoms() const { return static_cast<Eigen::Index>(where_.size()); }

 private:
  /// Where the numbers of a spring's block stand among the values of the matrix; -1: nowhere.
  struct Places {
    int from[3][3], to[3][3], between[3][3];
  };

  void add(const Places& places, const double (&block)[3][3]);

  const Physics& physics_;
  std::vector<Eigen::Index> where_; ///< [freedoms] index into a [3 * nodes] vector
  Sparse matrix_;
  std::vector<Places> places_; ///< [springs]
  std::vector<int> diagonal_;  ///< [freedoms]
};

} // namespace hopmesh::rivals
