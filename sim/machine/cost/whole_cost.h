// The cost of a whole array by the fitted model, in the figures of results.csv.
#pragma once

#include "sim/machine/cost/cost_model.h"
#include "sim/machine/cost/energy.h"

namespace hopmesh::machine {

/// Gates of a memory's bit: an estimate of ours for compiled memory with a port to read and one to write.
inline constexpr double gates_a_bit = 0.8;

/// Of logic, by the model.
double logic_kge(const CostPoint& parts);
double memory_kge(const spec::ArraySpec& array, const spec::Topology& topology);
/// Logic and memories.
double area_kge(const spec::ArraySpec& array, const spec::Topology& topology);

/// Joules of silicon_energy for all that was counted, with toggles as of a flag.
double energy_joule(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work,
                    std::uint64_t runs);

} // namespace hopmesh::machine
