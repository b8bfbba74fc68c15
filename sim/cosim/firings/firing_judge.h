// A file of firings, filled in by a core that is not ours, against the open neuron of a level.
#pragma once

#include "sim/cosim/firings/firing_files.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

struct FiringsJudged {
  std::uint64_t firings = 0;       ///< judged right
  std::vector<std::string> told;   ///< stages that every line tells
  std::vector<std::string> untold; ///< stages that a line leaves out
  std::string wrong;               ///< the first wrong stage of the first wrong firing, in words; ends it
  bool interrupted = false;
};

/// Throws input::InputError for what is no file of firings, and for a line without any answer.
FiringsJudged judge_firings(const std::string& path, const levels::Level& level);

} // namespace hopmesh::cosim
