// The exact motion of a scene, which runs are measured against: worked out by SUNDIALS, twice.
#pragma once

#include "sim/levels/built_mesh.h"

namespace hopmesh::levels {

/// At a few times; empty where nobody knows it.
struct ExactMotion {
  std::vector<std::vector<double>> positions; ///< [times] each [nodes * 3], m
  std::vector<double> floor;                  ///< [times] rms that two exact solutions differ by, m
};

/// In numbers, what it depends on beside mesh and times: not the method, not the time step but through
/// friction. Throws input::InputError for a scene whose exact motion nobody can compute.
std::vector<double> exact_surroundings(const scene::Scene& scene);

/// At each of the times, ascending, s; empty where SUNDIALS gives up. Throws as exact_surroundings() does.
ExactMotion exact_motion(const scene::Scene& scene, const BuiltMesh& mesh, const std::vector<double>& times);

} // namespace hopmesh::levels
