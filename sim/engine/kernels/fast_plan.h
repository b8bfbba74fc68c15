// What of an array's description the kernels can have, and how it looks to them.
#pragma once

#include "sim/engine/kernels/kernel.h"
#include "sim/engine/plan.h"

#include <string>

namespace hopmesh::engine {

int bit_length(std::uint64_t x);

/// Bits of the largest N that codes of these formats can make.
int norm_bits(const Plan& plan);
Normalise normalise_of(const Plan& plan);
/// What of s times the reciprocal lies behind the drive's last place.
int multiplier_places(const Plan& plan);

/// Empty if the kernels can compute the array, else why not, for people.
std::string why_no_kernel(const Plan& plan);

KernelRounding kernel_rounding(int places, spec::Rounding mode);
KernelDivision kernel_division(int ratio_up, spec::Rounding mode);

} // namespace hopmesh::engine
