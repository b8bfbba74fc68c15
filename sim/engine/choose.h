// Which core computes an array, on how many threads, and how far sweeps follow each other: what helps on this
// processor and this mesh. None of it changes a bit.
#pragma once

#include "sim/engine/core.h"

#include <string>

namespace hopmesh::engine {

/// "auto", then every core by name, whether or not this processor has what it needs.
const std::vector<std::string>& kernel_names();
/// Throws std::invalid_argument for a name that is none, or that this processor or this array cannot have.
std::unique_ptr<Core> make_core(const Plan& plan, const Layout& layout, const std::string& name);

/// Of at most so many threads, those that a mesh of this size keeps busy: 1 or more.
std::size_t useful_threads(const spec::Topology& topology, std::size_t at_most);
/// How many sweeps follow each other through the mesh. `asked`: 0 for what helps, 1 for plain sweeps.
std::size_t sweeps_to_follow(const spec::Topology& topology, std::size_t asked);
/// For Layout: 0 where one chunk is best. Levels of a sequential array run across chunks, so it has one.
std::size_t chunk_cells(const spec::Topology& topology, spec::Schedule schedule, std::size_t asked);

} // namespace hopmesh::engine
