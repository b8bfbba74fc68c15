#include "sim/levels/rival_mover.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/scene/scene_reader.h"

namespace hopmesh::levels {

namespace {

rivals::State state_of(const std::vector<double>& position, const std::vector<double>& velocity) {
  return {rivals::by_component(vector_of(position)), rivals::by_component(vector_of(velocity))};
}

rivals::Options options_of(const scene::Scene& scene) {
  rivals::Options options;
  options.tolerance = scene.rival.tolerance;
  return options;
}

} // namespace

rivals::Surroundings surroundings_of(const scene::Scene& scene) {
  if (scene.is_static())
    throw scene::scene_error(
        scene, "incremental.rule", "\"static\"",
        "a motion (backward_euler or bdf2) for rivals and truth, which walk through time");
  if (scene.mesh.law == scene::SpringLaw::tension)
    throw scene::scene_error(scene, "mesh.springs.law", "\"tension\"",
                             "\"linear\": rivals and truth know no other springs");
  if (scene.force.image)
    throw scene::scene_error(scene, "force.image.file", "an image",
                             "none: rivals and truth do not look at it");
  if (!(scene.motion.friction > 0))
    throw scene::scene_error(scene, "motion.friction", "0", "above 0 for a method with a drag");
  return rivals::Surroundings::of(scene);
}

RivalMover::RivalMover(const std::string& name, const scene::Scene& scene, const BuiltMesh& mesh)
    : mesh_(mesh), physics_(mesh.mesh(), surroundings_of(scene)), time_step_(scene.motion.time_step),
      method_(rivals::make_method(name, physics_, time_step_, options_of(scene))) {
  show_state();
}

void RivalMover::show_state() {
  position_ = values_of(method_->positions());
  velocity_ = values_of(method_->velocities());
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
    s.previous_position = values_of(rivals::by_node(before->position));
    s.previous_velocity = values_of(rivals::by_node(before->velocity));
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
