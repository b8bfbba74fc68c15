#include "sim/study/step_memory.h"

namespace hopmesh::study {

StepMemory::StepMemory(const BuiltMesh& mesh) {
  position.reserve(3 * mesh.nodes());
  for (const auto& x : mesh.mesh().position) position.insert(position.end(), x.begin(), x.end());
  velocity.assign(position.size(), 0.0);
  acceleration = predicted = previous_position = previous_velocity = velocity;
  energy_change.assign(mesh.cells(), 0.0);
  direction.assign(3 * mesh.cells(), 0.0);
  start.assign(mesh.cells() * mesh.components(), 0.0);
  bias = output = start;
  weight.assign(hm_weight_count(&mesh.firmware()), 0.0);
  state.position = position.data();
  state.velocity = velocity.data();
  state.acceleration = acceleration.data();
  state.previous_position = previous_position.data();
  state.previous_velocity = previous_velocity.data();
  state.predicted = predicted.data();
  state.energy_change = energy_change.data();
  state.direction = direction.data();
  state.start = start.data();
  state.network = {weight.data(), bias.data(), output.data()};
}

} // namespace hopmesh::study
