// How far the motions of a study's points are decided: what two references that start a last place apart
// differ by. Points of the same scene and order of firing share it: it is worked out once and lies in the
// study's folder.
#pragma once

#include "sim/study/point_runner.h"

#include <filesystem>

namespace hopmesh::study {

class SensitivityStore {
 public:
  explicit SensitivityStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Rms at each of the times, s, in m; none where a reference did not come so far, or the user stopped it.
  /// Throws files::DamagedFile where what lies there is not as it was written.
  std::vector<Maybe> at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                        const std::vector<double>& times) const;

 private:
  std::filesystem::path folder_;
};

} // namespace hopmesh::study
