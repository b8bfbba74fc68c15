#include "sim/levels/rival_mover.h"

namespace hopmesh::levels {

namespace {

std::vector<double> values(const rivals::Vector& v) {
  return {v.data(), v.data() + v.size()};
}

rivals::State state_of(const std::vector<double>& position, const std::vector<double>& velocity) {
  const auto vector = [](const std::vector<double>& by_node) {
    return rivals::by_component(
        Eigen::Map<const rivals::Vector>(by_node.data(), static_cast<Eigen::Index>(by_node.size())));
  };
  return {vector(position), vector(velocity)};
}

} // namespace

RivalMover::RivalMover(const std::string& name, const scene::Scene& scene, const BuiltMesh& mesh)
    : mesh_(mesh), physics_(mesh.mesh(), rivals::surroundings_of(scene)), time_step_(scene.motion.time_step),
      method_(rivals::make_method(name, physics_, time_step_)) {
  show_state();
}

void RivalMover::show_state() {
  position_ = values(method_->positions());
  velocity_ = values(method_->velocities());
}

StepRow RivalMover::advance() {
  try {
    method_->advance();
  } catch (const rivals::LostMotion& lost) {
    throw LostMotion(lost.what());
  }
  show_state();
  StepRow row;
  row.step = step_++;
  row.time = static_cast<double>(step_) * time_step_;
  row.converged = true; // an iteration that does not converge has thrown
  measure(mesh_.mesh(), position_.data(), velocity_.data(), row);
  row.hash = state_hash(state());
  return row;
}

StepState RivalMover::state() const {
  StepState s;
  s.step = step_;
  s.position = position_;
  s.velocity = velocity_;
  if (const rivals::State* before = method_->before()) {
    s.previous_position = values(rivals::by_node(before->position));
    s.previous_velocity = values(rivals::by_node(before->velocity));
  }
  return s;
}

void RivalMover::restore(const StepState& state, const std::vector<SignalRange>&) {
  const auto differs = [&](const std::vector<double>& v) { return v.size() != position_.size(); };
  const bool looks_back = !state.previous_position.empty();
  if (differs(state.position) || differs(state.velocity) ||
      (looks_back && (differs(state.previous_position) || differs(state.previous_velocity))))
    throw std::logic_error("the state of another mesh");
  step_ = state.step;
  const rivals::State now = state_of(state.position, state.velocity);
  const rivals::State before = state_of(state.previous_position, state.previous_velocity);
  method_->go_on_from(now, state.previous_position.empty() ? nullptr : &before);
  show_state();
}

} // namespace hopmesh::levels
