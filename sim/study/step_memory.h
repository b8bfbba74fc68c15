// The arrays that the firmware's integrator works in: on a small processor static memory, here vectors.
#pragma once

#include "firmware/integrator.h"
#include "sim/study/built_mesh.h"

namespace hopmesh::study {

/// A mesh at rest in its first position, and hm_state pointing into this object; it neither moves nor copies.
struct StepMemory {
  explicit StepMemory(const BuiltMesh& mesh);
  StepMemory(const StepMemory&) = delete;
  StepMemory& operator=(const StepMemory&) = delete;

  std::vector<double> position, velocity, acceleration, predicted; ///< [nodes * 3]
  std::vector<double> previous_position, previous_velocity;        ///< [nodes * 3]
  std::vector<double> energy_change;                               ///< [cells]
  std::vector<double> direction;                                   ///< [cells * 3]
  std::vector<double> start, weight, bias, output;                 ///< as hm_network
  hm_state state{};
};

} // namespace hopmesh::study
