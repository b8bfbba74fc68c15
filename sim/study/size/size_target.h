// Where the motion of a scene that is sized should end.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/run/snapshots.h"

#include <filesystem>

namespace hopmesh::study {

struct SizeTarget {
  run::Positions positions;
  std::uint64_t sweeps = 0; ///< of the reference, in all
  double reached = 0;       ///< how near double itself comes to the truth, m
  double floor = 0;         ///< how far the truth is known, m
  std::string trouble;      ///< why there is no target, if so
};

/// The end of the reference's free motion or, where `truth`, the exact one's, which lies in the folder.
/// Throws SearchStopped.
SizeTarget size_target(const levels::Prepared& prepared, bool truth, const std::filesystem::path& folder);

} // namespace hopmesh::study
