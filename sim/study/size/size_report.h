// What a search for the least array found: as files, and in words.
#pragma once

#include "sim/study/size/size.h"
#include "sim/study/size/size_search.h"
#include "sim/study/size/step_bounds.h"

namespace hopmesh::study {

/// Everything that a member refers to must outlive the report.
struct SizeReport {
  const SizeOrder& order;
  const levels::Prepared& prepared;
  const Sizing& sizing;
  const SizeFound& found;
  const TrialRow& given; ///< what the array that the search starts from comes to
  const std::filesystem::path& folder;
  double reached, floor;     ///< of the truth: how near double itself comes, and how far it is known, m
  double sensitivity;        ///< of the motion to the last place of its start, m
  std::uint64_t most_sweeps; ///< limit of sweeps of a step
  const StepBounds& bounds;
  std::optional<int> start_level; ///< of formats, tried first
};

/// size.toml, the array, and size.csv, the evidence.
void write_size(const SizeReport& report);
/// A few lines, with the commands that show the size.
std::string text_of(const SizeReport& report);

} // namespace hopmesh::study
