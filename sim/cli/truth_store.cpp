#include "sim/cli/truth_store.h"

#include "sim/record/npy.h"
#include "sim/rivals/method.h"
#include "sim/rivals/truth.h"
#include "sim/study/checkpoint.h"
#include "sim/study/step_state.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hopmesh::cli {

namespace {

namespace fs = std::filesystem;
using Snapshots = std::vector<std::vector<double>>;

constexpr double tolerance = 1e-11; // relative and absolute; far below what any rival reaches

// What the exact motion depends on: not the method, not the time step but through friction.
std::uint64_t hash_of(const rivals::Surroundings& around, const study::BuiltMesh& mesh,
                      const std::vector<double>& times) {
  std::vector<double> numbers{around.force[0], around.force[1], around.force[2], around.drag};
  numbers.insert(numbers.end(), times.begin(), times.end());
  return study::hash_on(study::mesh_hash(mesh.mesh()), numbers.data(), numbers.size());
}

Snapshots solve(const rivals::Surroundings& around, const study::BuiltMesh& mesh,
                const std::vector<double>& times) {
  const rivals::Physics physics(mesh.mesh(), around);
  rivals::Walk walk(physics, rivals::Multistep::adams, tolerance);
  Snapshots all;
  for (double time : times) {
    walk.to(time);
    const rivals::Vector at = walk.positions();
    all.emplace_back(at.data(), at.data() + at.size());
  }
  return all;
}

// Two points may work out the same one at the same time: each writes a file of its own, the last name wins.
void keep(const fs::path& file, const Snapshots& all, std::size_t nodes) {
  fs::path own = file;
  own += fmt::format(".{}", getpid());
  record::NpyWriter<double> writer(own, {nodes, 3});
  for (const auto& positions : all) writer.append(positions);
  writer.commit();
  fs::rename(own, file);
}

Snapshots kept(const fs::path& file) {
  record::NpyReader<double> reader(file);
  Snapshots all;
  for (std::size_t k = 0; k < reader.rows(); ++k) all.push_back(reader.row(k));
  return all;
}

} // namespace

Snapshots TruthStore::positions(const scene::Inputs& inputs, const study::BuiltMesh& mesh,
                                const std::vector<double>& times) const {
  const rivals::Surroundings around = rivals::surroundings_of(inputs.scene);
  const fs::path file = folder_ / fmt::format("truth-{:016x}.npy", hash_of(around, mesh, times));
  if (fs::exists(file)) return kept(file);
  try {
    Snapshots all = solve(around, mesh, times);
    keep(file, all, mesh.nodes());
    return all;
  } catch (const rivals::Diverged&) {
    return {};
  }
}

} // namespace hopmesh::cli
