#include "sim/levels/reference_mover.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/levels/left_over.h"
#include "sim/levels/reference_check.h"
#include "sim/reference/judgement.h"
#include "sim/reference/rest.h"

#include <cmath>

namespace hopmesh::levels {

ReferenceMover::ReferenceMover(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array)
    : mesh_(mesh), motion_(motion_for(scene, array)), order_(order_for(mesh, array.schedule)),
      state_(reference::initial_state(mesh.mesh(), *motion_.formulation)),
      position_(state_.position.data(), state_.position.data() + state_.position.size()) {
  if (scene.force.image) image_.emplace(scene);
}

StepRow ReferenceMover::advance() {
  if (image_) motion_.node_force = vector_of(image_->at(position_));
  reference::State next = state_;
  last_ = reference::advance(mesh_.mesh(), motion_, order_, next);
  if (!next.position.allFinite() || !next.velocity.allFinite())
    throw LostMotion("a node has no finite position");
  state_ = next;
  position_.assign(state_.position.data(), state_.position.data() + state_.position.size());

  StepRow row;
  row.step = state_.step - 1;
  row.time = static_cast<double>(state_.step) * motion_.time_step;
  row.sweeps = last_.relaxation.sweeps;
  row.converged = last_.relaxation.converged;
  if (!row.converged) row.alternation = alternation(last_.network, order_, last_.relaxation.V, motion_.rule);
  row.refinements = last_.refinement.corrections;
  row.refused = last_.refinement.refused;
  if (motion_.refinements > 0) row.residual = last_.refinement.residual;
  row.input_left = input_left(last_.network, last_.relaxation.V);
  row.fall_left = left_of_fall();
  for (Eigen::Index k = 0; k < last_.relaxation.V.size(); ++k)
    row.saturated += std::fabs(last_.relaxation.V[k]) >= 1;
  measure(mesh_.mesh(), position_.data(), state_.velocity.data(), row);
  row.hash = state_hash(state());
  return row;
}

// Signs have no way down but their own rule.
double ReferenceMover::left_of_fall() {
  constexpr std::uint32_t sweeps_of_signs = 100;
  const reference::Vector& V = last_.relaxation.V;
  if (blocks_)
    blocks_->take(last_.network);
  else
    blocks_.emplace(last_.network, static_cast<Eigen::Index>(mesh_.components()));
  const reference::Vector rest =
      motion_.rule.neuron == reference::Neuron::binary
          ? reference::judge_signs(last_.network, order_, {last_.V0, V, 0}, sweeps_of_signs).rest
          : reference::rest_from(*blocks_, V).V;
  return fall_left(*blocks_, last_.V0, V, rest);
}

void ReferenceMover::answer_after(reference::SweepsOfSteps sweeps) {
  motion_.answer = reference::by_equal_sweeps(std::move(sweeps), motion_.rule);
}

void ReferenceMover::answer_at_rest() {
  motion_.answer = reference::by_rest(motion_, static_cast<Eigen::Index>(mesh_.components()));
}

StepState ReferenceMover::state() const {
  return {state_.step,
          values_of(state_.position),
          values_of(state_.velocity),
          values_of(state_.acceleration),
          values_of(state_.V),
          values_of(state_.previous_position),
          values_of(state_.previous_velocity),
          {}};
}

void ReferenceMover::restore(const StepState& state, const std::vector<SignalRange>&) {
  const auto copy = [](const std::vector<double>& from, reference::Vector& to) {
    if (static_cast<Eigen::Index>(from.size()) != to.size())
      throw std::logic_error("the state of another mesh");
    std::copy(from.begin(), from.end(), to.data());
  };
  state_.step = state.step;
  copy(state.position, state_.position);
  copy(state.velocity, state_.velocity);
  copy(state.acceleration, state_.acceleration);
  copy(state.output, state_.V);
  copy(state.previous_position, state_.previous_position);
  copy(state.previous_velocity, state_.previous_velocity);
  position_ = state.position;
}

} // namespace hopmesh::levels
