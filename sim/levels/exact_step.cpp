#include "sim/levels/exact_step.h"

namespace hopmesh::levels {

namespace {

// A rival would make a drag of friction, which is the truth's way of it, not the step's.
scene::Scene without_friction(scene::Scene scene) {
  scene.motion.friction = 1;
  return scene;
}

} // namespace

ExactStep::ExactStep(const scene::Scene& scene, const BuiltMesh& mesh)
    : rival_(name_of(scene.incremental.rule), without_friction(scene), mesh),
      friction_(scene.motion.friction) {}

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
