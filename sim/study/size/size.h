// The least array that meets an error on a scene: the whole of `size`, from its target to its evidence.
#pragma once

#include "sim/input/command_words.h"
#include "sim/levels/prepared.h"
#include "sim/run/outcome.h"

#include <filesystem>

namespace hopmesh::study {

/// What sizes may be measured against: the level that judges all others, or the truth.
std::vector<std::string> size_judges();

struct SizeOrder {
  input::InputWords words; ///< that name scene and array
  std::int64_t steps = 0;  ///< in place of the scene's number of steps; 0: the scene's
  double error = 0;        ///< rms of positions at the end, m
  double time_per_step = 0;
  std::string against = size_judges().front();
  std::size_t workers = 1;
};

struct SizeEnd {
  run::Outcome outcome; ///< failed: no array meets the order
  std::string text;     ///< for people
};
/// `prepared`: what the order's words name. Leaves size.toml and size.csv in the folder, and goes on with
/// what an earlier search left there. Throws input::InputError, also for an error that the last place of the
/// start decides, and files::WriteError.
SizeEnd size_array(const SizeOrder& order, const levels::Prepared& prepared,
                   const std::filesystem::path& folder);

} // namespace hopmesh::study
