// Backward Euler and BDF2, each step solved by Newton's method; drag implicit in both.
#include "sim/rivals/all_integrators.h"
#include "sim/rivals/newton.h"

namespace hopmesh::rivals {
namespace {

/// Each rule reads x = past_x + b v, v = past_v + b (F(x) / m + force - c v); they differ in the past and in
/// b.
class ImplicitRule : public Method {
 public:
  ImplicitRule(std::string name, const Physics& physics, double time_step, const Options& options)
      : Method(std::move(name), physics, time_step), newton_(physics, options) {}

 protected:
  void solve(const Vector& past_position, const Vector& past_velocity, double b) {
    const double braked = physics_.slowed(b);
    problem_.inertia = physics_.mass() * braked / (b * b);
    problem_.y = past_position + b / braked * (past_velocity + b * physics_.external());
    x_ = problem_.y;
    if (!newton_.minimise(problem_, x_, counters_)) diverge("Newton's iteration came to no rest");
    state_.velocity = (x_ - past_position) / b;
    state_.position = x_;
  }

 private:
  Newton newton_;
  Implicit problem_;
  Vector x_;
};

class BackwardEuler : public ImplicitRule {
 public:
  BackwardEuler(const Physics& physics, double time_step, const Options& options)
      : ImplicitRule("backward_euler", physics, time_step, options) {}

 private:
  void step() override { solve(state_.position, state_.velocity, time_step_); }
};

/// The first step, which has no past, is backward Euler's.
class Bdf2 : public ImplicitRule {
 public:
  Bdf2(const Physics& physics, double time_step, const Options& options)
      : ImplicitRule("bdf2", physics, time_step, options) {}

 private:
  void step() override {
    const State now = state_;
    if (before_)
      solve((4 * now.position - before_->position) / 3, (4 * now.velocity - before_->velocity) / 3,
            2 * time_step_ / 3);
    else
      solve(now.position, now.velocity, time_step_);
    before_ = now;
  }
};

} // namespace

std::unique_ptr<Method> backward_euler(const Physics& physics, double time_step, const Options& options) {
  return std::make_unique<BackwardEuler>(physics, time_step, options);
}

std::unique_ptr<Method> bdf2(const Physics& physics, double time_step, const Options& options) {
  return std::make_unique<Bdf2>(physics, time_step, options);
}

} // namespace hopmesh::rivals
