// Steps that did not come to rest, in words for people.
#pragma once

#include "sim/run/run_totals.h"

namespace hopmesh::run {

/// A step that leaves more than this of its fall to go is not at rest, whatever ended it. Where nobody has
/// looked for the rest, only max_sweeps tells.
inline constexpr double most_fall_left = 0.1;

/// Did a step stop before its network had come to rest?
bool is_unrested(const levels::StepRow& row);

/// A sentence about such steps of a motion; empty where there is none.
std::string unrest_text(const StepRows& rows);

} // namespace hopmesh::run
