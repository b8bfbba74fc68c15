// The problem every implicit method here solves in a step, min inertia/2 |x - y|^2 + E(x), by Newton's
// method.
#pragma once

#include "sim/rivals/integrator.h"
#include "sim/rivals/stiffness.h"

#include <Eigen/SparseCholesky>

namespace hopmesh::rivals {

/// y is where the nodes would go without springs; inertia is m (1 + drag part) / b^2 with b the method's
/// share of the time step.
struct Implicit {
  Vector y;
  double inertia;
};

class Newton {
 public:
  Newton(const Physics& physics, const Options& options);

  /// From the x given to the minimum. Full Hessian, the projected one where that has a negative direction;
  /// Armijo's line search. False if it did not come to rest within max_iterations.
  bool minimise(const Implicit& problem, Vector& x, Counters& counters);

 private:
  double value(const Implicit& problem, const Vector& x) const;
  bool find_direction(const Implicit& problem, const Vector& x, Counters& counters);
  bool factorise(const Vector& x, double inertia, bool projected, Counters& counters);
  void search(const Implicit& problem, Vector& x);

  const Physics& physics_;
  const double tolerance_;
  const int max_iterations_;
  Stiffness stiffness_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> solver_;
  Vector gradient_, direction_, trial_, free_;
};

} // namespace hopmesh::rivals
