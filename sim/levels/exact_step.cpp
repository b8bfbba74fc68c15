#include "sim/levels/exact_step.h"

#include <algorithm>

namespace hopmesh::levels {

namespace {

// A rival would make a drag of friction, which is the truth's way of it, not the step's; and it may be asked
// to stop early.
scene::Scene exact_scene(scene::Scene scene) {
  scene.motion.friction = 1;
  scene.rival = {};
  return scene;
}

} // namespace

bool ExactStep::exists_for(const scene::Scene& scene) {
  const auto& rivals = rivals::names();
  return std::find(rivals.begin(), rivals.end(), scene.formulation_name()) != rivals.end();
}

ExactStep::ExactStep(const scene::Scene& scene, const BuiltMesh& mesh)
    : rival_(scene.formulation_name(), exact_scene(scene), mesh), friction_(scene.motion.friction) {}

StepRow ExactStep::advance() {
  StepRow row = rival_.advance();
  if (friction_ == 1) return row;
  StepState state = rival_.state();
  for (double& v : state.velocity) v *= friction_;
  rival_.restore(state, {});
  row.kinetic *= friction_ * friction_;
  row.hash = state_hash(state);
  return row;
}

} // namespace hopmesh::levels
