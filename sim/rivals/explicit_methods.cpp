// Methods that only look: symplectic Euler, velocity Verlet, the classical Runge-Kutta method of order 4.
#include "sim/rivals/all_integrators.h"

namespace hopmesh::rivals {
namespace {

class SymplecticEuler : public Method {
 public:
  SymplecticEuler(const Physics& physics, double time_step)
      : Method("symplectic_euler", physics, time_step), force_(Vector::Zero(3 * physics.nodes())) {}

 private:
  void step() override {
    const double dt = time_step_;
    physics_.spring_forces(state_.position, force_);
    ++counters_.force_passes;
    physics_.kick(physics_.kept(dt), dt, force_, state_.velocity);
    state_.position += dt * state_.velocity;
  }

  Vector force_;
};

/// Kick, drift, kick; drag explicit in the first half and implicit in the second, so that order 2 needs one
/// pass a step.
class VelocityVerlet : public Method {
 public:
  VelocityVerlet(const Physics& physics, double time_step)
      : Method("velocity_verlet", physics, time_step), force_(Vector::Zero(3 * physics.nodes())) {}

  void start_from(const State& state) override {
    Method::start_from(state);
    knows_force_ = false;
  }

 private:
  void find_force() {
    physics_.spring_forces(state_.position, force_);
    ++counters_.force_passes;
    knows_force_ = true;
  }

  void step() override {
    if (!knows_force_) find_force();
    const double half = time_step_ / 2, lost = 1 / physics_.slowed(half);
    physics_.kick(physics_.kept(half), half, force_, state_.velocity);
    state_.position += time_step_ * state_.velocity;
    find_force();
    physics_.kick(lost, lost * half, force_, state_.velocity);
  }

  Vector force_; ///< at the present position
  bool knows_force_ = false;
};

class RungeKutta4 : public Method {
 public:
  RungeKutta4(const Physics& physics, double time_step) : Method("rk4", physics, time_step) {
    for (State& k : slope_) k = physics.initial_state();
    probe_ = physics.initial_state();
  }

 private:
  void slope(const State& at, State& result) {
    result.position = at.velocity;
    physics_.acceleration(at.position, at.velocity, result.velocity);
    ++counters_.force_passes;
  }

  const State& ahead(double time, const State& k) {
    probe_.position = state_.position + time * k.position;
    probe_.velocity = state_.velocity + time * k.velocity;
    return probe_;
  }

  void step() override {
    const double dt = time_step_;
    slope(state_, slope_[0]);
    slope(ahead(dt / 2, slope_[0]), slope_[1]);
    slope(ahead(dt / 2, slope_[1]), slope_[2]);
    slope(ahead(dt, slope_[2]), slope_[3]);
    const auto& [k1, k2, k3, k4] = slope_;
    state_.position += dt / 6 * (k1.position + 2 * (k2.position + k3.position) + k4.position);
    state_.velocity += dt / 6 * (k1.velocity + 2 * (k2.velocity + k3.velocity) + k4.velocity);
  }

  State slope_[4], probe_;
};

} // namespace

std::unique_ptr<Method> symplectic_euler(const Physics& physics, double time_step, const Options&) {
  return std::make_unique<SymplecticEuler>(physics, time_step);
}

std::unique_ptr<Method> velocity_verlet(const Physics& physics, double time_step, const Options&) {
  return std::make_unique<VelocityVerlet>(physics, time_step);
}

std::unique_ptr<Method> rk4(const Physics& physics, double time_step, const Options&) {
  return std::make_unique<RungeKutta4>(physics, time_step);
}

} // namespace hopmesh::rivals
