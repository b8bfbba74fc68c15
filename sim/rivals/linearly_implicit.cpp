// The linearly implicit Euler step of Baraff and Witkin (1998): linearised once, solved by conjugate
// gradients that are preconditioned by the nodes' 3 x 3 blocks. They linearise where the step begins; here,
// as in the array, it is where the step would end with the acceleration of the step before, which is nearer
// to the answer.
#include "sim/rivals/all_integrators.h"
#include "sim/rivals/tangent.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

constexpr double gradients_tolerance = 1e-9; // m
constexpr Eigen::Index most_rounds = 100;    // as many iterations as coordinates, so many times

class LinearlyImplicit : public Method {
 public:
  LinearlyImplicit(const Physics& physics, double time_step, const Options& options)
      : Method("linearly_implicit", physics, time_step),
        tolerance_(options.tolerance_or(gradients_tolerance)), tangent_(physics),
        place_(Vector::Zero(3 * physics.nodes())), y_(place_), way_(place_), residual_(place_),
        preconditioned_(place_), direction_(place_), product_(place_) {}

 private:
  void step() override {
    linearise();
    solve();
    before_ = state_;
    state_.position = place_ + way_;
    state_.velocity = (state_.position - before_->position) / time_step_;
  }

  /// The step asks for inertia (x - y) = spring forces at x: here about `place`, of the way from there.
  void linearise() {
    const double dt = time_step_, braked = physics_.slowed(dt);
    const double inertia = physics_.mass() * braked / (dt * dt);
    y_ = state_.position + dt / braked * (state_.velocity + dt * physics_.external());
    place_ = y_;
    if (before_) place_ = state_.position + dt * (2 * state_.velocity - before_->velocity);
    tangent_.expand_about(place_, inertia);
    physics_.spring_forces(place_, residual_);
    residual_ = (residual_ + inertia * (y_ - place_)).cwiseProduct(moves_);
    ++counters_.force_passes;
  }

  /// From no way at all; the residual is then the right-hand side.
  void solve() {
    way_.setZero();
    tangent_.precondition(residual_, preconditioned_);
    direction_ = preconditioned_;
    double measure = residual_.dot(preconditioned_);
    ++counters_.linear_solves;
    for (Eigen::Index left = most_rounds * way_.size(); measure > 0; --left) {
      if (left == 0) diverge("conjugate gradients came to no rest");
      if (advance_way(measure)) return;
      tangent_.precondition(residual_, preconditioned_);
      const double before = measure;
      measure = residual_.dot(preconditioned_);
      direction_ = preconditioned_ + measure / before * direction_;
    }
  }

  /// True where it moved no coordinate by more than the tolerance.
  bool advance_way(double measure) {
    tangent_.multiply(direction_, product_);
    const double share = measure / direction_.dot(product_);
    way_ += share * direction_;
    residual_ -= share * product_;
    ++counters_.iterations;
    return share * direction_.lpNorm<Eigen::Infinity>() <= tolerance_;
  }

  const double tolerance_;
  Tangent tangent_;
  const Vector moves_ = physics_.inverse_mass() * physics_.mass(); ///< 1, or 0 where nothing moves
  Vector place_, y_, way_, residual_, preconditioned_, direction_, product_;
};

} // namespace

std::unique_ptr<Method> linearly_implicit(const Physics& physics, double time_step, const Options& options) {
  return std::make_unique<LinearlyImplicit>(physics, time_step, options);
}

} // namespace hopmesh::rivals
