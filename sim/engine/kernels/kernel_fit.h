// Which arrays the kernels can compute, and what such an array is in their terms.
#pragma once

#include "sim/engine/kernels/kernel.h"
#include "sim/engine/neuron_plan.h"

#include <string>

namespace hopmesh::engine {

Normalise normalise_of(const NeuronPlan& plan);
/// Why the kernels cannot compute the array, for people; empty if they can.
std::string why_no_kernel(const NeuronPlan& plan);

/// Do slim kernels have a way for momentum with these formats? Its rows are judged at START.
bool fits_slim(const NeuronPlan& plan);
KernelQuotient slim_quotient(const NeuronPlan& plan);
/// After so many blocks, sums of Delta V might leave 32 bits.
std::size_t slim_blocks(const NeuronPlan& plan);
/// Of slim kernels, may those that multiply take u from the upper half of a product?
bool fits_brief(const NeuronPlan& plan);

/// What kernels read of the array's description; memories are the caller's to point at.
KernelArgs arguments_of(const NeuronPlan& plan);
KernelDivision kernel_division(int ratio_up, spec::Rounding mode);

} // namespace hopmesh::engine
