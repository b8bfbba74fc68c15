// Motions of scenes, and one time step of the probe formulation: predict, expand, relax, advance
// (docs/method/theory.md, section 4).
#include "sim/reference/components.h"

#include <cmath>

namespace hopmesh::reference {
namespace {

// What is free to move: x, y, z, or x and z.
Vector3 moving_part(const scene::Mesh& mesh, Vector3 v) {
  if (mesh.planar) v.y() = 0;
  return v;
}

Vector3 unit_or(const Vector3& v, const Vector3& otherwise) {
  const double length = v.norm();
  return length < shortest_direction ? otherwise : Vector3(v / length);
}

// The probe's answer: V_i / |V_i| for every node as [3 * nodes]; a node at rest in the middle of the box has
// none.
Vector directions(const scene::Mesh& mesh, const Vector& V) {
  Vector all(3 * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    at(all, node) = unit_or(output(mesh, V, node), Vector3::Zero());
  return all;
}

// Delta E_i of every node (paper eq. 6): node i at C_i + h dahat_i and all others at C_j, minus everything at
// x, over the springs of the node. For `all` springs the others' change from x to C, the same for every i, is
// added: each spring of the node then counts from C instead of x.
Vector energy_changes(const scene::Mesh& mesh, const Motion& motion, const Vector& x, const Vector& C,
                      const Vector& dahat) {
  const double h = motion.time_step * motion.time_step / 2;
  const bool all = motion.energy_of_all_springs;
  const Vector& from = all ? C : x;
  const Vector probed = C + h * dahat;
  Vector change =
      Vector::Constant(nodes_of(mesh), all ? spring_energy(mesh, C) - spring_energy(mesh, x) : 0.0);
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const double before = spring_term(mesh, spring, at(from, i), at(from, j));
    change[i] += spring_term(mesh, spring, at(probed, i), at(C, j)) - before;
    change[j] += spring_term(mesh, spring, at(C, i), at(probed, j)) - before;
  }
  return change;
}

// Paper eqs. 5 and 7, friction, force: in this order, each line using what the line before made.
void move_node(const Motion& motion, const Vector3& kick, const Vector3& force, Eigen::Index node,
               State& state) {
  const double dt = motion.time_step, h = dt * dt / 2;
  auto x = at(state.position, node), v = at(state.velocity, node), a = at(state.acceleration, node);
  a = a * motion.acceleration_memory + kick;
  x += v * dt + h * a;
  v = (v + a * dt) * motion.friction;
  if (motion.force_on_acceleration)
    a += force;
  else
    v += dt * force;
}

// All nodes at once: what drives them is computed from the old state before the first one moves.
void move(const scene::Mesh& mesh, const Motion& motion, const Step& step, State& state) {
  const Vector dahat = directions(mesh, step.relaxation.V);
  const Vector change = energy_changes(mesh, motion, state.position, step.predicted, dahat);
  const Vector3 force = moving_part(mesh, motion.force);
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const Vector3 kick = at(dahat, node) * std::sqrt(std::abs(motion.gamma * change[node]));
    move_node(motion, kick, force, node, state);
  }
}

Vector3 vector(const scene::Vector3& v) {
  return {v[0], v[1], v[2]};
}

Rule rule_of(scene::Rule rule) {
  if (rule == scene::Rule::statics) return Rule::statics;
  return rule == scene::Rule::bdf2 ? Rule::bdf2 : Rule::backward_euler;
}

} // namespace

Motion motion_of(const scene::Scene& scene) {
  Motion motion;
  motion.time_step = scene.motion.time_step;
  motion.friction = scene.motion.friction;
  motion.gamma = scene.probe.gamma;
  motion.beta = scene.probe.beta;
  motion.acceleration_memory = scene.probe.acceleration_memory;
  motion.energy_of_all_springs = scene.probe.energy_springs == scene::EnergySprings::all;
  motion.force_on_acceleration = scene.probe.force_on == scene::ForceOn::acceleration;
  motion.mass = scene.mesh.mass;
  motion.drag = scene.force.drag;
  if (scene.motion.formulation == scene::Formulation::incremental)
    motion.rule = rule_of(scene.incremental.rule);
  else
    motion.friction /= 1 + motion.drag * motion.time_step;
  motion.force = vector(scene.force.gravity) + vector(scene.force.wind.value_or(scene::Vector3{0, 0, 0}));
  motion.threshold = scene.relax.threshold;
  motion.max_sweeps = static_cast<std::uint32_t>(scene.relax.max_sweeps);
  motion.expansions = static_cast<std::uint32_t>(scene.relax.expansions);
  return motion;
}

State initial_state(const scene::Mesh& mesh, Rule rule) {
  State state;
  state.position.resize(3 * nodes_of(mesh));
  state.velocity = state.acceleration = Vector::Zero(3 * nodes_of(mesh));
  if (rule == Rule::bdf2) state.previous_position = state.previous_velocity = state.velocity;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    at(state.position, node) = vector(mesh.position[node]);
    at(state.velocity, node) = vector(mesh.start_velocity(node));
  }
  state.V = Vector::Zero(components(mesh) * nodes_of(mesh));
  return state;
}

// docs/method/theory.md, section 1: C_i = x_i + v_i dt + h memory a_i, and x_i where pinned.
Vector predict(const scene::Mesh& mesh, const Motion& motion, const State& state) {
  const double dt = motion.time_step, h = dt * dt / 2;
  Vector predicted = state.position;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    if (!mesh.pinned[node])
      at(predicted, node) +=
          at(state.velocity, node) * dt + h * motion.acceleration_memory * at(state.acceleration, node);
  return predicted;
}

// docs/method/theory.md, section 2.
Vector expansion_point(const scene::Mesh& mesh, const State& state) {
  Vector V0 = Vector::Zero(components(mesh) * nodes_of(mesh));
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const Vector3 rest = state.step == 0 ? Vector3::Zero() : output(mesh, state.V, node);
    set_output(mesh, V0, node, unit_or(rest, default_direction()));
  }
  return V0;
}

// docs/method/theory.md, section 4 (probe). With more than one expansion the step reports the last one,
// sweeps summed: from V0, its network comes to rest at relaxation.V.
Step advance_probe(const scene::Mesh& mesh, const Motion& motion, const Order& order, State& state) {
  Step step;
  step.predicted = predict(mesh, motion, state);
  step.relaxation.V = expansion_point(mesh, state);
  for (std::uint32_t expansion = 0; expansion < motion.expansions; ++expansion) {
    const std::uint32_t sweeps_before = step.relaxation.sweeps;
    step.V0 = step.relaxation.V;
    step.network = network(mesh, motion, step.predicted, step.V0);
    step.relaxation = relax(step.network, order, step.V0, motion.threshold, motion.max_sweeps, motion.output);
    step.relaxation.sweeps += sweeps_before;
  }
  move(mesh, motion, step, state);
  return step;
}

Step advance(const scene::Mesh& mesh, const Motion& motion, const Order& order, State& state) {
  Step step = motion.rule == Rule::probe ? advance_probe(mesh, motion, order, state)
                                         : advance_incremental(mesh, motion, order, state);
  state.V = step.relaxation.V;
  ++state.step;
  return step;
}

} // namespace hopmesh::reference
