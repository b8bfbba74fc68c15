// The motion of a step that only looks for rest.
#pragma once

#include "sim/reference/reference.h"

namespace hopmesh::tests {

/// Relaxed to the end, one expansion a step.
inline reference::StepParameters static_motion() {
  reference::StepParameters motion{};
  motion.formulation = &reference::statics;
  motion.mass = motion.time_step = motion.friction = 1;
  motion.force.setZero();
  motion.threshold = 1e-16, motion.max_sweeps = 20000, motion.expansions = 1;
  return motion;
}

} // namespace hopmesh::tests
