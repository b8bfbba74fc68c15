// Who answers a network otherwise than by its scene's threshold and max_sweeps.
#pragma once

#include "sim/reference/reference.h"

namespace hopmesh::reference {

/// [steps][relaxations] sweeps that an array took.
using SweepsOfSteps = std::vector<std::vector<std::uint32_t>>;

/// By as many sweeps as an array took. A reference that looks longer for its scale takes the array's last
/// count again; behind the array's last step none is taken.
Answerer by_equal_sweeps(SweepsOfSteps sweeps, const NeuronRule& rule);

/// By the rest: of signs where the rule itself comes to, else the one that lies down from where the rule
/// would have stopped. Converged where it is found. `components`: of a node.
Answerer by_rest(const StepParameters& motion, Eigen::Index components);

} // namespace hopmesh::reference
