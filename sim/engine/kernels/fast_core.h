// Arrays with 16-bit weights and links, sixteen cells at a time, in the widest registers there are.
#pragma once

#include "sim/engine/kernels/kernel.h"
#include "sim/engine/sweep_core.h"

#include <string>

namespace hopmesh::engine {

/// The kernels of this name, or null where the processor cannot run them; "" finds the best.
const KernelSet* kernel_set(const std::string& name);

/// The array must fit the kernels.
std::unique_ptr<SweepCore> make_fast_core(const NeuronPlan& plan, const Layout& layout,
                                          const KernelSet& kernels);

} // namespace hopmesh::engine
