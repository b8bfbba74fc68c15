#include "sim/study/reference_store.h"

#include "sim/files/running_check.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/checkpoint.h"
#include "sim/study/kept_positions.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

/// Empty positions where the motion ended before.
FreeMotion fly(const scene::Inputs& inputs, const levels::BuiltMesh& mesh, const std::vector<double>& times,
               std::uint64_t steps, const std::atomic<bool>& stop) {
  levels::ReferenceMover motion(inputs.scene, mesh, inputs.array);
  run::Snapshots snapshots(times, inputs.scene.motion.time_step);
  const run::RunResult result = run::simulate(motion, steps, {&snapshots}, stop);
  FreeMotion free{std::move(snapshots.at), {}};
  if (result.rows.size() == steps) free.last = motion.positions();
  return free;
}

/// As one motion, its end behind the times; its floor is 0, because it is what others are held against.
/// Nothing where a position is missing.
levels::ExactMotion whole(const FreeMotion& free) {
  levels::ExactMotion all{free.at, std::vector<double>(free.at.size() + 1, 0.0)};
  all.positions.push_back(free.last);
  const bool missing = std::any_of(all.positions.begin(), all.positions.end(),
                                   [](const run::Positions& at) { return at.empty(); });
  return missing ? levels::ExactMotion() : all;
}

} // namespace

std::uint64_t reference_hash(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                             const std::vector<double>& times, std::uint64_t steps) {
  files::RunningCheck check;
  scene::Scene scene = inputs.scene;
  scene.rival = {}; // the reference is none
  const std::string text =
      fmt::format("{} {} {} {} {}", run::mesh_hash(mesh.mesh()), static_cast<int>(inputs.array.schedule),
                  static_cast<int>(inputs.array.output), steps, scene::scene_text(scene));
  check.add(text.data(), text.size());
  check.add(times.data(), times.size() * sizeof(double));
  return check.value();
}

FreeMotion ReferenceStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                              const std::vector<double>& times, std::uint64_t steps,
                              const std::atomic<bool>& stop) const {
  const std::uint64_t hash = reference_hash(inputs, mesh, times, steps);
  std::vector<double> with_end = times;
  with_end.push_back(static_cast<double>(steps) * inputs.scene.motion.time_step);
  FreeMotion free;
  levels::ExactMotion kept =
      kept_positions(folder_ / fmt::format("reference-{:016x}", hash), with_end, mesh.nodes(), [&] {
        free = fly(inputs, mesh, times, steps, stop);
        return whole(free);
      });
  if (kept.positions.empty()) return free;
  free.last = std::move(kept.positions.back());
  kept.positions.pop_back();
  free.at = std::move(kept.positions);
  return free;
}

} // namespace hopmesh::study
