// One step's network as the rivals' solvers take it, and where they start.
#pragma once

#include "sim/cli/options.h"
#include "sim/rivals/quadratic/problem.h"

namespace hopmesh::cli {

struct StepStart {
  bool cold = false;    ///< from zero, which is the prediction; else from the step before
  bool still = false;   ///< from where the mesh stands, expanded there
  double time_step = 0; ///< still: of the step asked about; 0: the scene's
};

/// Over all nodes, pinned ones among them. `motion` has just done the step, `before` is what it began from.
/// Throws scene::InputError where a scene of the probe is to start still.
rivals::quadratic::Problem step_problem(const study::ReferenceMotion& motion, const study::StepState& before,
                                        const Prepared& prepared, const StepStart& start);

} // namespace hopmesh::cli
