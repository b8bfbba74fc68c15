#include "sim/study/reference_store.h"

#include "sim/files/npy.h"
#include "sim/files/running_check.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

// What the motion depends on: of the array, who fires when, and whether outputs are signs.
std::uint64_t hash_of(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                      const std::vector<double>& times, std::uint64_t steps) {
  const std::uint64_t built = run::mesh_hash(mesh.mesh());
  files::RunningCheck check;
  const std::string text =
      fmt::format("{} {} {} {} {}", built, static_cast<int>(inputs.array.schedule),
                  static_cast<int>(inputs.array.output), steps, scene::scene_text(inputs.scene));
  check.add(text.data(), text.size());
  check.add(times.data(), times.size() * sizeof(double));
  return check.value();
}

FreeMotion fly(const scene::Inputs& inputs, const levels::BuiltMesh& mesh, const std::vector<double>& times,
               std::uint64_t steps, const std::atomic<bool>& stop) {
  levels::ReferenceMover motion(inputs.scene, mesh, inputs.array);
  run::Snapshots snapshots(times, inputs.scene.motion.time_step);
  const run::RunResult result = run::simulate(motion, steps, {&snapshots}, stop);
  FreeMotion free{std::move(snapshots.at), {}};
  if (result.rows.size() == steps) free.last = motion.positions();
  return free;
}

bool is_whole(const FreeMotion& free) {
  bool whole = !free.last.empty();
  for (const run::Positions& at : free.at) whole = whole && !at.empty();
  return whole;
}

// Two points may fly the same one at the same time: each writes a file of its own, the last name wins.
void save(const fs::path& file, const FreeMotion& free, std::size_t nodes) {
  const fs::path own = file.string() + fmt::format(".{}", getpid());
  files::NpyWriter<double> positions(own, {nodes, 3});
  for (const run::Positions& at : free.at) positions.append(at);
  positions.append(free.last);
  positions.commit();
  fs::rename(own, file);
}

FreeMotion saved(const fs::path& file) {
  FreeMotion free;
  files::NpyReader<double> positions(file);
  for (std::size_t k = 0; k + 1 < positions.rows(); ++k) free.at.push_back(positions.row(k));
  free.last = positions.row(positions.rows() - 1);
  return free;
}

} // namespace

FreeMotion ReferenceStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                              const std::vector<double>& times, std::uint64_t steps,
                              const std::atomic<bool>& stop) const {
  const fs::path file = folder_ / fmt::format("reference-{:016x}.npy", hash_of(inputs, mesh, times, steps));
  if (fs::exists(file)) return saved(file);
  FreeMotion free = fly(inputs, mesh, times, steps, stop);
  if (is_whole(free)) save(file, free, mesh.nodes());
  return free;
}

} // namespace hopmesh::study
