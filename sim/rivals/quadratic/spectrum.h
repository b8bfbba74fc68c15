// The largest eigenvalue of -W: what a gradient step must stay below.
#pragma once

#include "sim/rivals/quadratic/problem.h"

namespace hopmesh::rivals::quadratic {

/// By power iteration, which comes from below: 2 % are added, so that 1 / curvature is a safe step.
double largest_curvature(const Problem& problem);

} // namespace hopmesh::rivals::quadratic
