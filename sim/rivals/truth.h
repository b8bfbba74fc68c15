// The truth: the same equation of motion by two methods of SUNDIALS that share nothing but it, with tight
// tolerances. What they differ by is the floor below which no error of a rival means anything.
#pragma once

#include "sim/rivals/physics.h"

#include <memory>

namespace hopmesh::rivals {

struct Truth {
  std::vector<Vector> positions; ///< at each time: [3 * nodes] node by node, by Adams
  std::vector<double> floor; ///< at each time: rms over moving nodes of the distance to the other one's, m
  std::uint64_t force_passes = 0;
};

enum class Multistep { adams, bdf };

/// A walk of CVODE from the initial state: Adams with fixed-point iteration, or BDF with Newton and GMRES.
class Walk {
 public:
  Walk(const Physics& physics, Multistep multistep, double rtol);
  ~Walk();
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  void to(double time);     ///< throws LostMotion (integrator.h) where CVODE gives up
  void one_internal_step(); ///< as far as CVODE wants to go in one
  Vector positions() const; ///< [3 * nodes] node by node
  std::uint64_t force_passes() const;
  std::uint64_t steps() const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

/// Times ascending from 0. Throws std::invalid_argument for others and for a tolerance outside 1e-14..1e-3,
/// which SUNDIALS advises against.
Truth solve(const Physics& physics, const std::vector<double>& times, double rtol = 1e-12);

} // namespace hopmesh::rivals
