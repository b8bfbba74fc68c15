// Newton's method with a sparse factorisation and a line search.
#include "sim/rivals/newton.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

constexpr double sufficient = 1e-4;         // Armijo's share of the promised fall
constexpr double too_small_to_judge = 1e-7; // m: below it the fall of the energy drowns in its own rounding
constexpr int most_halvings = 40;
constexpr double newton_tolerance = 1e-9; // m

} // namespace

Newton::Newton(const Physics& physics, const Options& options)
    : physics_(physics), tolerance_(options.tolerance_or(newton_tolerance)),
      max_iterations_(options.max_iterations), stiffness_(physics),
      gradient_(Vector::Zero(3 * physics.nodes())), direction_(gradient_) {
  solver_.analyzePattern(stiffness_.lower());
}

double Newton::value(const Implicit& problem, const Vector& x) const {
  return problem.inertia / 2 * (x - problem.y).squaredNorm() + physics_.spring_energy(x);
}

bool Newton::factorise(const Vector& x, double inertia, bool projected, Counters& counters) {
  stiffness_.assemble(x, inertia, projected);
  solver_.factorize(stiffness_.lower());
  ++counters.factorisations;
  return solver_.info() == Eigen::Success && solver_.vectorD().minCoeff() > 0;
}

bool Newton::find_direction(const Implicit& problem, const Vector& x, Counters& counters) {
  physics_.spring_forces(x, gradient_);
  gradient_ = problem.inertia * (x - problem.y) - gradient_;
  if (!factorise(x, problem.inertia, false, counters) && !factorise(x, problem.inertia, true, counters))
    return false;
  stiffness_.gather(gradient_, free_);
  stiffness_.scatter(-solver_.solve(free_), direction_);
  ++counters.force_passes;
  ++counters.linear_solves;
  ++counters.iterations;
  return true;
}

void Newton::search(const Implicit& problem, Vector& x) {
  double share = 1;
  trial_ = x + direction_;
  if (direction_.lpNorm<Eigen::Infinity>() > too_small_to_judge) {
    const double start = value(problem, x);
    const double slope = gradient_.dot(direction_); // what cannot move has no direction
    for (int k = 0; k < most_halvings && !(value(problem, trial_) <= start + sufficient * share * slope);
         ++k) {
      share /= 2;
      trial_ = x + share * direction_;
    }
  }
  x.swap(trial_);
}

bool Newton::minimise(const Implicit& problem, Vector& x, Counters& counters) {
  double before = INFINITY;
  for (int iteration = 0; iteration < max_iterations_; ++iteration) {
    if (!find_direction(problem, x, counters)) return false;
    search(problem, x);
    const double moved = direction_.lpNorm<Eigen::Infinity>();
    if (moved <= tolerance_) return true;
    // A tolerance below rounding: as near as doubles get.
    if (moved < 1e-12 && moved >= before / 2) return true;
    before = moved;
  }
  return false;
}

} // namespace hopmesh::rivals
