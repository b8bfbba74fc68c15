#include "sim/networks/step_problem.h"

#include "sim/levels/image_force.h"
#include "sim/levels/reference_check.h"

#include <cmath>

namespace hopmesh::networks {

namespace {

using reference::Vector;
using solvers::Problem;

Problem problem_of(const reference::Network& network, const Vector& start, const levels::BuiltMesh& mesh) {
  std::vector<std::uint32_t> component(static_cast<std::size_t>(start.size()));
  for (std::size_t i = 0; i < component.size(); ++i) component[i] = i % mesh.components();
  return {network.W, network.I, start, levels::order_for(mesh, spec::Schedule::coloured), component};
}

reference::Increment increment_of(const levels::Prepared& p, const reference::State& state,
                                  double time_step) {
  reference::StepParameters motion = reference::step_parameters(p.inputs.scene);
  if (time_step > 0) motion.time_step = time_step;
  if (p.inputs.scene.force.image) {
    levels::ImageForce image(p.inputs.scene);
    const auto& pull = image.at({state.position.data(), state.position.data() + state.position.size()});
    motion.node_force = Eigen::Map<const Vector>(pull.data(), static_cast<Eigen::Index>(pull.size()));
  }
  return reference::increment(p.mesh->mesh(), motion, state);
}

// The scale leaves room: the way back to where the mesh stands is an output of 1/2 at most.
Problem still_problem(const reference::Increment& increment, const Vector& place,
                      const levels::BuiltMesh& mesh, double usual_scale) {
  const Vector back = (place - increment.predicted) / increment.h;
  const double farthest = back.lpNorm<Eigen::Infinity>();
  const double scale = farthest > 0 ? std::exp2(std::ceil(std::log2(2 * farthest))) : usual_scale;
  reference::State state;
  state.acceleration = back;
  const Vector start = reference::expansion_point(mesh.mesh(), state, scale);
  return problem_of(reference::network(mesh.mesh(), increment, scale, start), start, mesh);
}

} // namespace

Problem step_problem(const levels::ReferenceMover& motion, const levels::StepState& before,
                     const levels::Prepared& p, const StepStart& how) {
  const reference::Step& step = motion.last_step();
  const reference::State state = levels::state_of(before);
  if (how.still) {
    if (!motion.formulation().increment)
      throw input::input_error("", 0, "--still", "a scene of the probe", "formulation = \"incremental\"");
    return still_problem(increment_of(p, state, how.time_step), state.position, *p.mesh, step.scale);
  }
  Vector start = step.V0;
  if (how.cold)
    start.setZero();
  else if (motion.formulation().increment)
    start = motion.formulation().start(p.mesh->mesh(), state, step.scale);
  return problem_of(step.network, start, *p.mesh);
}

} // namespace hopmesh::networks
