// The largest eigenvalue of -W: what a gradient step must stay below.
#pragma once

#include "sim/networks/solvers/problem.h"

namespace hopmesh::solvers {

/// By power iteration, which comes from below: 2 % are added, so that 1 / curvature is a safe step.
double largest_curvature(const Problem& problem);

} // namespace hopmesh::solvers
