// What of an array's description the kernels can have, and how it looks to them.
#pragma once

#include "sim/engine/kernels/kernel.h"
#include "sim/engine/plan.h"

#include <string>

namespace hopmesh::engine {

Normalise normalise_of(const Plan& plan);
/// Empty if the kernels can compute the array, else why not, for people.
std::string why_no_kernel(const Plan& plan);

KernelDivision kernel_division(int ratio_up, spec::Rounding mode);

} // namespace hopmesh::engine
