// Projective dynamics: backward Euler with a matrix that never changes. Setting every spring to its rest
// length along its present direction (local) and solving for the nodes (global) is the step -A^-1 gradient,
// because A x - (what the projected springs ask for) is the gradient itself: one force pass is the whole
// local part.
#include "sim/rivals/all_integrators.h"
#include "sim/rivals/node_solver.h"

namespace hopmesh::rivals {
namespace {

double inertia_of(const Physics& physics, double dt) {
  return physics.mass() * physics.slowed(dt) / (dt * dt);
}

constexpr int own_iterations = 20, most_iterations = 1'000'000;

class ProjectiveDynamics : public Method {
 public:
  ProjectiveDynamics(const Physics& physics, double time_step, const Options& options)
      : Method("projective_dynamics", physics, time_step), tolerance_(options.tolerance),
        iterations_(options.iterations > 0 ? options.iterations
                    : tolerance_ > 0       ? most_iterations
                                           : own_iterations),
        solver_(physics, inertia_of(physics, time_step)), x_(Vector::Zero(3 * physics.nodes())), y_(x_),
        gradient_(x_) {}

 private:
  void step() override {
    const double dt = time_step_, braked = physics_.slowed(dt);
    const double inertia = inertia_of(physics_, dt);
    y_ = state_.position + dt / braked * (state_.velocity + dt * physics_.external());
    x_ = y_;
    int left = iterations_;
    while (left > 0 && !iterate(inertia)) --left;
    if (left == 0 && iterations_ == most_iterations) diverge("its local and global solves came to no rest");
    state_.velocity = (x_ - state_.position) / dt;
    state_.position = x_;
  }

  /// True where it moved no coordinate by more than the tolerance.
  bool iterate(double inertia) {
    physics_.spring_forces(x_, gradient_);
    gradient_ = (inertia * (x_ - y_) - gradient_).cwiseProduct(moves_);
    solver_.solve(gradient_);
    x_ -= gradient_;
    ++counters_.force_passes;
    ++counters_.linear_solves;
    ++counters_.iterations;
    return tolerance_ > 0 && gradient_.lpNorm<Eigen::Infinity>() <= tolerance_;
  }

  const double tolerance_;
  const int iterations_;
  NodeSolver solver_;
  Vector x_, y_, gradient_;
  const Vector moves_ = physics_.inverse_mass() * physics_.mass(); ///< 1, or 0 where nothing moves
};

} // namespace

std::unique_ptr<Method> projective_dynamics(const Physics& physics, double time_step,
                                            const Options& options) {
  return std::make_unique<ProjectiveDynamics>(physics, time_step, options);
}

} // namespace hopmesh::rivals
