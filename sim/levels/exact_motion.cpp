#include "sim/levels/exact_motion.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/levels/rival_mover.h"
#include "sim/rivals/truth.h"

namespace hopmesh::levels {

namespace {

constexpr double tolerance = 1e-11; // relative and absolute; far below what any rival reaches

} // namespace

std::vector<double> exact_surroundings(const scene::Scene& scene) {
  return surroundings_of(scene).numbers();
}

ExactMotion exact_motion(const scene::Scene& scene, const BuiltMesh& mesh, const std::vector<double>& times) {
  const rivals::Physics physics(mesh.mesh(), surroundings_of(scene));
  try {
    rivals::Truth found = rivals::solve(physics, times, tolerance);
    ExactMotion exact{{}, std::move(found.floor)};
    for (const rivals::Vector& at : found.positions) exact.positions.push_back(values_of(at));
    return exact;
  } catch (const rivals::LostMotion&) {
    return {};
  }
}

} // namespace hopmesh::levels
