// Which core computes an array, on how many threads, and how many sweeps follow each other: what is fastest
// on this processor and this mesh. No such choice changes a bit.
#pragma once

#include "sim/engine/sweep_core.h"

#include <string>

namespace hopmesh::engine {

/// "auto", then every core by name, whether or not this processor has what it needs.
const std::vector<std::string>& kernel_names();
/// Throws std::invalid_argument for an unknown name, and for a core that this processor or this array cannot
/// have.
std::unique_ptr<SweepCore> make_core(const NeuronPlan& plan, const Layout& layout, const std::string& name);

/// Why none of the kernels can have this array, for people; empty if they can.
std::string why_generic(const NeuronPlan& plan);

/// How many threads a mesh of this size keeps busy: from 1 to `at_most`.
std::size_t useful_threads(const spec::Topology& topology, std::size_t at_most);
/// How many sweeps follow each other through the mesh. `asked`: 0 leaves the choice to this function, 1 asks
/// for plain sweeps.
std::size_t sweeps_to_follow(const spec::Topology& topology, std::size_t asked);
/// The length of a chunk that Layout should cut; 0: the whole mesh is one chunk, as in sequential arrays,
/// whose groups run across chunks.
std::size_t chunk_cells(const spec::Topology& topology, spec::Schedule schedule, std::size_t asked);

} // namespace hopmesh::engine
