// A sparse factorisation of -W on some of a problem's outputs.
#pragma once

#include "sim/levels/networks/definite_part.h"
#include "sim/networks/solvers/problem.h"

namespace hopmesh::solvers {

using Factor = levels::DefinitePart;

std::vector<Eigen::Index> all_outputs(const Problem& problem);
/// Whether -W is positive definite.
bool is_convex(const Problem& problem);

} // namespace hopmesh::solvers
