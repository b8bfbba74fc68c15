// A step linearised about a place: the springs' stiffness with inertia on its diagonal, never put together as
// a matrix, and its 3 x 3 diagonal blocks inverted.
#pragma once

#include "sim/rivals/physics.h"

namespace hopmesh::rivals {

class Tangent {
 public:
  explicit Tangent(const Physics& physics); ///< must outlive it

  /// `inertia` on every coordinate, N/m. Compressed springs do as those at rest: the whole is positive
  /// definite.
  void expand_about(In position, double inertia);
  /// [3 * nodes], component by component; 0 where nothing moves. What does not move in `vector` must be 0.
  void multiply(In vector, Out product);
  /// The inverse of the diagonal blocks times `residual`; 0 where nothing moves.
  void precondition(In residual, Out result) const;

 private:
  Tangents at(Eigen::Index first);
  void invert_blocks();

  const Physics& physics_;
  const Vector moves_;   ///< [3 * nodes] 1, or 0 where nothing moves
  double inertia_ = 0;   ///< N/m
  Vector tangents_;      ///< four numbers a spring: sideways, x, y, z, all [springs of the pass]
  Eigen::ArrayXd block_; ///< [6 * nodes] xx, yy, zz, xy, xz, yz: of the matrix, then of the inverses
};

} // namespace hopmesh::rivals
