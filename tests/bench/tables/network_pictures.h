// The pictures of docs/findings/problem-set.md, made by the program's own results.
#pragma once

#include "tests/bench/tables/problem_runs.h"

namespace hopmesh::bench {

/// PNG: a pattern as stored, with a fifth of its signs turned, and as the engine recalls it.
std::string recall_picture(const ProblemRuns& runs);
/// SVG: sweeps to rest against the diagonal, W_ii = d sum |W_ij|, at the engine and the reference.
/// Also prints its numbers.
std::string diagonal_chart(const ProblemRuns& runs);

} // namespace hopmesh::bench
