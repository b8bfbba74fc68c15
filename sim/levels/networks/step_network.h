// The network of one step of a scene as the reference has it, and where it starts.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/levels/reference_mover.h"

namespace hopmesh::levels {

struct StepStart {
  bool cold = false;    ///< from zero, which is the prediction; else from the step before
  bool still = false;   ///< from where the mesh stands, expanded there
  double time_step = 0; ///< still: of the step asked about; 0: the scene's
};

struct StepNetwork {
  Eigen::SparseMatrix<double, Eigen::RowMajor> W;
  Eigen::VectorXd I, start;
};

/// Over all nodes, pinned ones among them. `motion` has just done the step, `before` is what it began from.
/// Throws input::InputError where a scene of the probe is to start still.
StepNetwork step_network(const ReferenceMover& motion, const StepState& before, const Prepared& prepared,
                         const StepStart& how);

} // namespace hopmesh::levels
