// The equation of motion of a scene that rivals and truth solve, free of any method:
// m dv/dt = spring forces - m c v + m force, springs E = sum alpha (|x_i - x_j| - L)^2, pinned nodes at rest.
#pragma once

#include "sim/rivals/force_pass.h"
#include "sim/scene/mesh.h"

namespace hopmesh::rivals {

/// Positions, velocities: [3 * nodes] component by component (all x, all y, all z), so that passes over
/// springs run over neighbouring numbers. `by_node` turns one into the order of everybody else.
struct State {
  Vector position, velocity;
};

Vector by_node(const Vector& by_component);
Vector by_component(const Vector& by_node);

/// What acts on every free node beside its springs.
struct Surroundings {
  scene::Vector3 force{0, 0, 0}; ///< acceleration, m/s^2
  double drag = 0;               ///< c, 1/s

  /// Gravity plus wind; the air's drag, and friction, a factor on v each step, as the drag
  /// -ln(friction) / time_step that loses as much: of friction 0, which stops every motion, there is none.
  static Surroundings of(const scene::Scene& scene);
  /// All of them, for whoever tells two surroundings apart.
  std::vector<double> numbers() const { return {force[0], force[1], force[2], drag}; }
};

class Physics {
 public:
  Physics(const scene::Mesh& mesh, const Surroundings& surroundings);

  Eigen::Index nodes() const { return nodes_; }
  double mass() const { return mass_; }
  /// What drag leaves of a velocity after dt s taken explicitly, and what divides it taken implicitly.
  double kept(double dt) const { return 1 - drag_ * dt; }
  double slowed(double dt) const { return 1 + drag_ * dt; }
  const std::vector<scene::Spring>& springs() const { return springs_; }
  /// [3 * nodes]: 1 / mass, 0 where nothing moves (pinned; y of planar meshes).
  const Vector& inverse_mass() const { return inverse_mass_; }
  /// [3 * nodes]: gravity plus wind, 0 where nothing moves.
  const Vector& external() const { return external_; }
  const State& initial_state() const { return initial_; }

  /// Overwrites `force` with what the springs do at `position`.
  void spring_forces(In position, const Out& force) const { pass_.forces(position, force); }
  /// velocity = kept * velocity + time * (force / mass + gravity and wind), 0 where nothing moves.
  void kick(double kept, double time, In force, Out velocity) const;
  /// By springs, surroundings and drag.
  void acceleration(In position, In velocity, Out result) const;
  const ForcePass& pass() const { return pass_; }
  double spring_energy(In position) const { return pass_.energy(position); }
  /// Kinetic, spring and potential energy, J.
  double energy(const State& state) const;

 private:
  Eigen::Index nodes_;
  double mass_, drag_;
  std::vector<scene::Spring> springs_;
  ForcePass pass_;
  Vector inverse_mass_, external_;
  State initial_;
};

} // namespace hopmesh::rivals
