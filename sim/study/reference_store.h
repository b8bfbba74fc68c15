// The reference's free motions that a study's points are measured against. Points of the same scene and order
// of firing ask for the same one, whatever their words: it is flown once and lies in the study's folder.
#pragma once

#include "sim/study/point_runner.h"

#include <filesystem>

namespace hopmesh::study {

class ReferenceStore {
 public:
  explicit ReferenceStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Positions at each of the times, ascending, s, and after so many steps; empty where the motion ended
  /// before.
  FreeMotion at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh, const std::vector<double>& times,
                std::uint64_t steps, const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path folder_;
};

} // namespace hopmesh::study
