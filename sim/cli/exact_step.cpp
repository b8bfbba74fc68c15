#include "sim/cli/exact_step.h"

namespace hopmesh::cli {

namespace {

// A rival would make a drag of friction, which is the truth's way of it, not the step's.
scene::Scene without_friction(scene::Scene scene) {
  scene.motion.friction = 1;
  return scene;
}

} // namespace

ExactStep::ExactStep(const scene::Scene& scene, const study::BuiltMesh& mesh)
    : rival_(scene.formulation_name(), without_friction(scene), mesh), friction_(scene.motion.friction) {}

study::StepRow ExactStep::advance() {
  study::StepRow row = rival_.advance();
  if (friction_ == 1) return row;
  study::StepState state = rival_.state();
  for (double& v : state.velocity) v *= friction_;
  rival_.restore(state, {});
  row.kinetic *= friction_ * friction_;
  row.hash = study::state_hash(state);
  return row;
}

} // namespace hopmesh::cli
