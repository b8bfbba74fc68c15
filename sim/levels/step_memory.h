// The arrays that the firmware's integrator works in: on a small processor static memory, here vectors.
#pragma once

#include "firmware/integrator.h"
#include "sim/levels/built_mesh.h"
#include "sim/levels/step_state.h"

namespace hopmesh::levels {

/// A mesh at its start, and hm_state pointing into this object; it neither moves nor copies.
struct StepMemory {
  /// `looks_back`: as the formulation does.
  explicit StepMemory(const BuiltMesh& mesh, bool looks_back = false);
  /// Room for corrections.
  void make_room();
  StepMemory(const StepMemory&) = delete;
  StepMemory& operator=(const StepMemory&) = delete;

  StepState now;                           ///< as hm_state, but for the count of steps, which hm_state keeps
  std::vector<double> predicted;           ///< [nodes * 3]
  std::vector<double> energy_change;       ///< [cells]
  std::vector<double> direction;           ///< [cells * 3]
  std::vector<double> start, weight, bias; ///< as hm_network
  std::vector<double> correction;          ///< of the firmware's corrections; empty: it makes none
  hm_state state{};
};

} // namespace hopmesh::levels
