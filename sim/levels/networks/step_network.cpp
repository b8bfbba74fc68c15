#include "sim/levels/networks/step_network.h"

#include "sim/input/input_error.h"
#include "sim/levels/eigen_vectors.h"

#include <cmath>

namespace hopmesh::levels {

namespace {

using reference::Vector;

reference::Increment increment_of(const Prepared& p, const reference::State& state, double time_step) {
  reference::StepParameters motion = reference::step_parameters(p.inputs.scene);
  if (time_step > 0) motion.time_step = time_step;
  if (p.inputs.scene.force.image)
    motion.node_force = vector_of(ImageForce(p.inputs.scene).at(values_of(state.position)));
  return reference::increment(p.mesh->mesh(), motion, state);
}

// The scale leaves room: the way back to where the mesh stands is an output of 1/2 at most.
StepNetwork still_network(const reference::Increment& increment, const Vector& place, const scene::Mesh& mesh,
                          double usual_scale) {
  const Vector back = (place - increment.predicted) / increment.h;
  const double farthest = back.lpNorm<Eigen::Infinity>();
  const double scale = farthest > 0 ? std::exp2(std::ceil(std::log2(2 * farthest))) : usual_scale;
  reference::State state;
  state.acceleration = back;
  const Vector start = reference::expansion_point(mesh, state, scale);
  const reference::Network network = reference::network(mesh, increment, scale, start);
  return {network.W, network.I, start};
}

} // namespace

StepNetwork step_network(const ReferenceMover& motion, const StepState& before, const Prepared& p,
                         const StepStart& how) {
  const reference::Step& step = motion.last_step();
  const reference::State state = state_of(before);
  const bool increment = motion.formulation().increment;
  if (how.still) {
    if (!increment)
      throw input::input_error("", 0, "--still", "a scene of the probe", "formulation = \"incremental\"");
    return still_network(increment_of(p, state, how.time_step), state.position, p.mesh->mesh(), step.scale);
  }
  Vector start = step.V0;
  if (how.cold)
    start.setZero();
  else if (increment)
    start = motion.formulation().start(p.mesh->mesh(), state, step.scale);
  return {step.network.W, step.network.I, start};
}

} // namespace hopmesh::levels
