// Steps that did not come to rest, in words for people: a run that has such steps is done, yet not green.
#pragma once

#include "sim/run/run_totals.h"

#include <array>

namespace hopmesh::run {

/// A step that leaves more than this of its fall to go is not at rest, whatever ended it.
inline constexpr double most_fall_left = 0.1;

/// Did a step end before its network had come to rest? For any of the reasons in unrest.cpp.
bool is_unrested(const levels::StepRow& row);

/// How many steps of a motion were not at rest, reason by reason.
struct UnrestCount {
  std::uint64_t steps = 0, unrested = 0;
  std::array<std::uint64_t, 2> known{}, of{}; ///< the reasons in unrest.cpp: steps looked at, and those

  void add(const levels::StepRow& row);
  std::string text() const; ///< as unrest_text()
};

/// A sentence about such steps of a motion, each reason with its count; empty where there is none.
std::string unrest_text(const StepRows& rows);

} // namespace hopmesh::run
