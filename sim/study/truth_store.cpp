#include "sim/study/truth_store.h"

#include "sim/levels/step_state.h"
#include "sim/run/checkpoint.h"
#include "sim/study/kept_positions.h"

#include <fmt/format.h>

namespace hopmesh::study {

void TruthStore::expect_known(const scene::Scene& scene) {
  levels::exact_surroundings(scene);
}

Truth TruthStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                     const std::vector<double>& times) const {
  std::vector<double> numbers = levels::exact_surroundings(inputs.scene);
  numbers.insert(numbers.end(), times.begin(), times.end());
  const std::uint64_t hash = levels::hash_on(run::mesh_hash(mesh.mesh()), numbers.data(), numbers.size());
  const std::filesystem::path stem = folder_ / fmt::format("truth-{:016x}", hash);
  return kept_positions(stem, times, mesh.nodes(),
                        [&] { return levels::exact_motion(inputs.scene, mesh, times); });
}

} // namespace hopmesh::study
