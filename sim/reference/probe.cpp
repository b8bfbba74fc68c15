// A time step of the probe: predict, expand, relax, advance (docs/method/theory.md, section 4).
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
Vector energy_changes(const scene::Mesh& mesh, const StepParameters& motion, const Vector& x, const Vector& C,
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

// Paper eqs. 5 and 7, friction and what a drag leaves of it, force: in this order, each line using what the
// line before made.
void move_node(const StepParameters& motion, const Vector3& kick, const Vector3& force, Eigen::Index node,
               State& state) {
  const double dt = motion.time_step, h = dt * dt / 2, kept = motion.friction / (1 + motion.drag * dt);
  auto x = at(state.position, node), v = at(state.velocity, node), a = at(state.acceleration, node);
  a = a * motion.acceleration_memory + kick;
  x += v * dt + h * a;
  v = (v + a * dt) * kept;
  if (motion.force_on_acceleration)
    a += force;
  else
    v += dt * force;
}

// All nodes at once: what drives them is computed from the old state before the first one moves.
void move(const scene::Mesh& mesh, const StepParameters& motion, const Step& step, State& state) {
  const Vector dahat = directions(mesh, step.relaxation.V);
  const Vector change = energy_changes(mesh, motion, state.position, step.predicted, dahat);
  const Vector3 force = moving_part(mesh, motion.force);
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const Vector3 kick = at(dahat, node) * std::sqrt(std::abs(motion.gamma * change[node]));
    move_node(motion, kick, force, node, state);
  }
}

// docs/method/theory.md, section 4 (probe). With more than one expansion the step reports the last one,
// sweeps summed: from V0, its network comes to rest at relaxation.V.
Step advance_probe(const scene::Mesh& mesh, const StepParameters& motion, const Order& order, State& state) {
  Step step;
  step.predicted = predict(mesh, motion, state);
  step.relaxation.V = expansion_point(mesh, state);
  for (std::uint32_t expansion = 0; expansion < motion.expansions; ++expansion) {
    const std::uint32_t sweeps_before = step.relaxation.sweeps;
    step.V0 = step.relaxation.V;
    step.network = network(mesh, motion, step.predicted, step.V0);
    step.relaxation = answered(motion, step.network, order, step.V0, state.step);
    step.relaxation.sweeps += sweeps_before;
  }
  move(mesh, motion, step, state);
  return step;
}

Vector start(const scene::Mesh& mesh, const State& state, double) {
  return expansion_point(mesh, state);
}

Network probe_network(const scene::Mesh& mesh, const StepParameters& motion, const State& state, double,
                      const Vector& V0) {
  return network(mesh, motion, predict(mesh, motion, state), V0);
}

} // namespace

// docs/method/theory.md, section 1: C_i = x_i + v_i dt + h memory a_i, and x_i where pinned.
Vector predict(const scene::Mesh& mesh, const StepParameters& motion, const State& state) {
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

const Formulation probe{"probe", false, nullptr, start, probe_network, advance_probe};

} // namespace hopmesh::reference
