// Any array that the description allows.
#pragma once

#include "sim/engine/sweep_core.h"

namespace hopmesh::engine {

std::unique_ptr<SweepCore> make_generic_core(const NeuronPlan& plan, const Layout& layout);

} // namespace hopmesh::engine
