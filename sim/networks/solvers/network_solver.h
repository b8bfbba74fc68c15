// A way to the answer of one step's boxed quadratic, behind one small interface.
#pragma once

#include "sim/networks/solvers/problem.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace hopmesh::solvers {

/// The method does not apply to this problem; what() says why.
class Unfit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a solver in hardware has taken until now.
struct HardwareWork {
  std::uint64_t sweeps = 0, array_cycles = 0, bus_cycles = 0, multiplies = 0;
  double seconds = 0; ///< array and bus, at the array's clock
};

class Solver {
 public:
  virtual ~Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  virtual void sweep() = 0;              ///< one more sweep or iteration; throws Unfit
  const Vector& V() const { return V_; } ///< in the box
  /// None of what is no hardware. Its sweeps count, where a step of sweep() is more than one.
  virtual std::optional<HardwareWork> hardware() const { return std::nullopt; }
  std::uint64_t factorisations() const { return factorisations_; }

 protected:
  /// The problem must outlive the solver.
  explicit Solver(const Problem& problem) : problem_(problem), V_(problem.start) {}

  const Problem& problem_;
  Vector V_;
  std::uint64_t factorisations_ = 0;
};

const std::vector<std::string>& solver_names();

/// The problem as reached() leaves it. `convex`: whether -W is positive definite. Throws Unfit, and
/// std::invalid_argument for a name that is none of solver_names().
std::unique_ptr<Solver> make_solver(const std::string& name, const Problem& problem, bool convex);

} // namespace hopmesh::solvers
