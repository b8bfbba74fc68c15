// Accelerated projected gradient with restart (Nesterov 1983; O'Donoghue and Candes 2015).
#include "sim/networks/solvers/all_solvers.h"
#include "sim/networks/solvers/spectrum.h"

#include <cmath>

namespace hopmesh::solvers {
namespace {

class AcceleratedGradient : public Solver {
 public:
  explicit AcceleratedGradient(const Problem& problem)
      : Solver(problem), step_(1 / largest_curvature(problem)), y_(V_) {}

  void sweep() override {
    next_ = into_box(y_ + step_ * inputs(problem_, y_));
    const bool against = (y_ - next_).dot(next_ - V_) > 0; // the gradient's way and the momentum's
    const double t = against ? 1 : (1 + std::sqrt(1 + 4 * t_ * t_)) / 2;
    y_ = next_ + (against ? 0 : (t_ - 1) / t) * (next_ - V_);
    t_ = t;
    V_.swap(next_);
  }

 private:
  const double step_;
  double t_ = 1;
  Vector y_, next_;
};

} // namespace

std::unique_ptr<Solver> make_accelerated_gradient(const Problem& problem) {
  return std::make_unique<AcceleratedGradient>(problem);
}

} // namespace hopmesh::solvers
