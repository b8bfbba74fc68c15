// Conjugate gradients within a box: MPRGP (Dostal, Schoeberl 2005). Where no bound is met they are the plain
// ones.
#include "sim/networks/solvers/all_solvers.h"
#include "sim/networks/solvers/spectrum.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::solvers {
namespace {

class ConjugateGradient : public Solver {
 public:
  explicit ConjugateGradient(const Problem& problem)
      : Solver(problem), fixed_step_(1 / largest_curvature(problem)), gradient_(-inputs(problem, V_)) {
    direction_ = free_gradient();
  }

  void sweep() override {
    const Vector chopped = chopped_gradient();
    if (chopped.squaredNorm() <= reduced_gradient().dot(free_gradient()))
      conjugate_step();
    else
      release(chopped);
  }

 private:
  bool at_bound(Eigen::Index i) const { return std::abs(V_[i]) >= 1; }

  Vector free_gradient() const {
    Vector g = gradient_;
    for (Eigen::Index i = 0; i < g.size(); ++i)
      if (at_bound(i)) g[i] = 0;
    return g;
  }
  /// Where an output wants away from its bound.
  Vector chopped_gradient() const {
    Vector g = Vector::Zero(gradient_.size());
    for (Eigen::Index i = 0; i < g.size(); ++i)
      if (at_bound(i)) g[i] = V_[i] > 0 ? std::max(gradient_[i], 0.0) : std::min(gradient_[i], 0.0);
    return g;
  }
  /// The free gradient as far as the box lets a fixed step go.
  Vector reduced_gradient() const {
    return (V_ - into_box(V_ - fixed_step_ * free_gradient())) / fixed_step_;
  }

  /// The longest step against d within the box.
  double room(const Vector& d) const {
    double most = INFINITY;
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (d[i] != 0) most = std::min(most, (d[i] > 0 ? V_[i] + 1 : V_[i] - 1) / d[i]);
    return most;
  }

  void conjugate_step() {
    const Vector along = -(problem_.W * direction_);
    const double curvature = direction_.dot(along);
    if (!(curvature > 0)) return; // at rest
    const double step = gradient_.dot(direction_) / curvature, most = room(direction_);
    if (step > most) return expand(along, most);
    V_ = into_box(V_ - step * direction_);
    gradient_ -= step * along;
    const Vector free = free_gradient();
    direction_ = free - free.dot(along) / curvature * direction_;
  }

  // To the bound in the way, and on by a fixed step: more outputs may come to their bounds at once.
  void expand(const Vector& along, double most) {
    V_ = into_box(V_ - most * direction_);
    gradient_ -= most * along;
    V_ = into_box(V_ - fixed_step_ * free_gradient());
    begin_anew();
  }

  void release(const Vector& chopped) {
    const double step = gradient_.dot(chopped) / -chopped.dot(problem_.W * chopped);
    V_ = into_box(V_ - std::min(step, room(chopped)) * chopped);
    begin_anew();
  }

  void begin_anew() {
    gradient_ = -inputs(problem_, V_);
    direction_ = free_gradient();
  }

  const double fixed_step_;
  Vector gradient_, direction_;
};

} // namespace

std::unique_ptr<Solver> make_conjugate_gradient(const Problem& problem) {
  return std::make_unique<ConjugateGradient>(problem);
}

} // namespace hopmesh::solvers
