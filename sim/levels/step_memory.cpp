#include "sim/levels/step_memory.h"

namespace hopmesh::levels {

StepMemory::StepMemory(const BuiltMesh& mesh, bool looks_back) {
  now.position.reserve(3 * mesh.nodes());
  for (const auto& x : mesh.mesh().position) now.position.insert(now.position.end(), x.begin(), x.end());
  now.acceleration.assign(now.position.size(), 0.0);
  predicted = now.acceleration;
  if (looks_back) now.previous_position = now.previous_velocity = now.acceleration;
  now.velocity.reserve(now.position.size());
  for (std::size_t node = 0; node < mesh.nodes(); ++node) {
    const auto v = mesh.mesh().start_velocity(node);
    now.velocity.insert(now.velocity.end(), v.begin(), v.end());
  }
  energy_change.assign(mesh.cells(), 0.0);
  direction.assign(3 * mesh.cells(), 0.0);
  start.assign(mesh.cells() * mesh.components(), 0.0);
  bias = now.output = start;
  weight.assign(hm_weight_count(&mesh.firmware()), 0.0);
  state.position = now.position.data();
  state.velocity = now.velocity.data();
  state.acceleration = now.acceleration.data();
  state.previous_position = now.previous_position.data();
  state.previous_velocity = now.previous_velocity.data();
  state.predicted = predicted.data();
  state.energy_change = energy_change.data();
  state.direction = direction.data();
  state.start = start.data();
  state.network = {weight.data(), bias.data(), now.output.data()};
}

void StepMemory::make_room() {
  correction.assign(4 * start.size(), 0.0);
  state.correction = correction.data();
}

} // namespace hopmesh::levels
