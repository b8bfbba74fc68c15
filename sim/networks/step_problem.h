// A step's network as the rivals' solvers take it, and where they start.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/levels/reference_mover.h"
#include "sim/networks/solvers/problem.h"

namespace hopmesh::networks {

struct StepStart {
  bool cold = false;    ///< from zero, which is the prediction; else from the step before
  bool still = false;   ///< from where the mesh stands, expanded there
  double time_step = 0; ///< still: of the step asked about; 0: the scene's
};

/// Over all nodes, pinned ones among them. `motion` has just done the step, `before` is what it began from.
/// Throws input::InputError where a scene of the probe is to start still.
solvers::Problem step_problem(const levels::ReferenceMover& motion, const levels::StepState& before,
                              const levels::Prepared& prepared, const StepStart& start);

} // namespace hopmesh::networks
