// The reference's free motions that a study's points are measured against. Points of the same scene and order
// of firing ask for the same one, whatever their words: it is flown once and lies in the study's folder.
#pragma once

#include "sim/study/point_runner.h"

#include <filesystem>

namespace hopmesh::study {

/// Of all that the reference's motion depends on: of the array, that is who fires when, and whether outputs
/// are signs.
std::uint64_t reference_hash(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                             const std::vector<double>& times, std::uint64_t steps);

class ReferenceStore {
 public:
  explicit ReferenceStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Positions at each of the times, ascending, s, and after so many steps; empty where the motion ended
  /// before, or where the user stopped it. Throws files::DamagedFile where what lies there is not as it was
  /// written.
  FreeMotion at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh, const std::vector<double>& times,
                std::uint64_t steps, const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path folder_;
};

} // namespace hopmesh::study
