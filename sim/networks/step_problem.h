// A step's network as the rivals' solvers take it, and where they start.
#pragma once

#include "sim/levels/networks/step_network.h"
#include "sim/networks/solvers/problem.h"

namespace hopmesh::networks {

using levels::StepStart;

/// Of levels::step_network(), with the order and the components of its neurons.
solvers::Problem step_problem(const levels::ReferenceMover& motion, const levels::StepState& before,
                              const levels::Prepared& prepared, const StepStart& start);

} // namespace hopmesh::networks
