// The exact motions that a study's points are measured against. Points of the same physics ask for the same
// one: it is worked out once and lies in the study's folder.
#pragma once

#include "sim/study/point_runner.h"

#include <filesystem>

namespace hopmesh::study {

class TruthStore {
 public:
  explicit TruthStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws input::InputError for a scene whose exact motion nobody can compute.
  static void expect_known(const scene::Scene& scene);
  /// At each of the times, ascending, s; empty where SUNDIALS gives up, or the user while another process
  /// works it out. Throws files::DamagedFile where the one that lies there is not as it was written.
  Truth at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
           const std::vector<double>& times) const;

 private:
  std::filesystem::path folder_;
};

} // namespace hopmesh::study
