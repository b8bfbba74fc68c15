// Motions of scenes, and one time step whatever its formulation.
#include "sim/reference/components.h"

#include <stdexcept>

namespace hopmesh::reference {
namespace {

Vector3 vector(const scene::Vector3& v) {
  return {v[0], v[1], v[2]};
}

const Formulation* formulation_named(const std::string& name) {
  for (const Formulation* known : formulations)
    if (known->name == name) return known;
  throw std::logic_error("no formulation " + name);
}

} // namespace

StepParameters step_parameters(const scene::Scene& scene) {
  StepParameters motion;
  motion.time_step = scene.motion.time_step;
  motion.friction = scene.motion.friction;
  motion.gamma = scene.probe.gamma;
  motion.beta = scene.probe.beta;
  motion.acceleration_memory = scene.probe.acceleration_memory;
  motion.energy_of_all_springs = scene.probe.energy_springs == scene::EnergySprings::all;
  motion.force_on_acceleration = scene.probe.force_on == scene::ForceOn::acceleration;
  motion.mass = scene.mesh.mass;
  motion.drag = scene.force.drag;
  motion.formulation = formulation_named(scene.formulation_name());
  motion.force = vector(scene.force.gravity) + vector(scene.force.wind.value_or(scene::Vector3{0, 0, 0}));
  motion.threshold = scene.relax.threshold;
  motion.max_sweeps = static_cast<std::uint32_t>(scene.relax.max_sweeps);
  motion.expansions = static_cast<std::uint32_t>(scene.relax.expansions);
  motion.refinements = static_cast<std::uint32_t>(scene.relax.refinements);
  return motion;
}

State initial_state(const scene::Mesh& mesh, const Formulation& formulation) {
  State state;
  state.position.resize(3 * nodes_of(mesh));
  state.velocity = state.acceleration = Vector::Zero(3 * nodes_of(mesh));
  if (formulation.looks_back) state.previous_position = state.previous_velocity = state.velocity;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    at(state.position, node) = vector(mesh.position[node]);
    at(state.velocity, node) = vector(mesh.start_velocity(node));
  }
  state.V = Vector::Zero(components(mesh) * nodes_of(mesh));
  return state;
}

Relaxation answered(const StepParameters& motion, const Network& network, const Order& order,
                    const Vector& V0, std::uint64_t step) {
  if (motion.answer) return motion.answer(network, order, V0, step);
  return relax(network, order, V0, motion.stop(), motion.rule);
}

Step advance(const scene::Mesh& mesh, const StepParameters& motion, const Order& order, State& state) {
  Step step = motion.formulation->advance(mesh, motion, order, state);
  state.V = step.relaxation.V;
  ++state.step;
  return step;
}

} // namespace hopmesh::reference
