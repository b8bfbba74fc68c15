#include "sim/study/reference_motion.h"

#include <cmath>
#include <xxhash.h>

namespace hopmesh::study {

ReferenceMotion::ReferenceMotion(const scene::Scene& scene, const BuiltMesh& mesh, spec::Schedule schedule)
    : mesh_(mesh), motion_(reference::motion_of(scene)), order_(order_for(mesh, schedule)),
      state_(reference::initial_state(mesh.mesh())),
      position_(state_.position.data(), state_.position.data() + state_.position.size()) {}

StepRow ReferenceMotion::advance() {
  reference::State next = state_;
  last_ = reference::advance(mesh_.mesh(), motion_, order_, next);
  if (!next.position.allFinite() || !next.velocity.allFinite())
    throw Diverged("a node has no finite position");
  state_ = next;
  position_.assign(state_.position.data(), state_.position.data() + state_.position.size());

  StepRow row;
  row.step = state_.step - 1;
  row.time = static_cast<double>(state_.step) * motion_.time_step;
  row.sweeps = last_.relaxation.sweeps;
  row.converged = last_.relaxation.converged;
  for (Eigen::Index k = 0; k < last_.relaxation.V.size(); ++k)
    row.saturated += std::fabs(last_.relaxation.V[k]) >= 1;
  measure(mesh_.mesh(), position_.data(), state_.velocity.data(), row);
  for (const auto* values : {&state_.position, &state_.velocity, &state_.acceleration, &state_.V})
    row.hash = XXH64(values->data(), static_cast<std::size_t>(values->size()) * sizeof(double), row.hash);
  return row;
}

} // namespace hopmesh::study
