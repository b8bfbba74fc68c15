// The search of `size` in three stages: formats with the scene's own relaxation, so that the array file alone
// meets the error; then threshold and sweeps of that array; then lanes.
#pragma once

#include "sim/study/size/size_trials.h"

namespace hopmesh::study {

struct SizeGoal {
  double error = 0;              ///< rms of positions at the end, m
  double time_per_step = 0;      ///< s, of the slowest step on hardware; 0: the knee
  std::uint64_t most_sweeps = 0; ///< in all: bits are not to be bought with sweeps
  double clock_mhz = 100;
  std::size_t most_taps = 1;
  std::optional<int> start_level = {}; ///< of all formats, to be tried first: where formats prove enough
};

/// A line of the evidence: what was tried beside the size, and what came of it.
struct SizeEvidence {
  std::string what, knob; ///< "size", "array file", "one less", "two less", "lanes"
  Setting setting;
  TrialRow row;
  std::string fails_by; ///< "", or what it fails by: "error", "sweeps", "time", or how the motion ended
};

struct SizeFound {
  bool reached = false;
  double least_error = 0; ///< of all that was tried
  std::string why;        ///< in a sentence, where nothing reaches the goal
  Setting setting;        ///< with the sweeps found
  Setting file;           ///< the same array with the scene's own relaxation
  std::vector<SizeEvidence> evidence;
  std::uint64_t tried = 0, met = 0, cheaper = 0; ///< formats tried, met the error, and at less silicon
};

SizeFound find_size(const Sizing& sizing, const SizeGoal& goal, SizeTrials& trials);

} // namespace hopmesh::study
