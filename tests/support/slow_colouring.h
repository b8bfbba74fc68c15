// The colouring of rtl_model/spec/colouring.h as its rule says it, with sets of the standard library: slow,
// obvious, and what the fast one must find, colour by colour.
#pragma once

#include "rtl_model/spec/topology.h"

namespace hopmesh::tests {

/// DSATUR; ties to the higher degree, then the lower number.
std::vector<std::uint32_t> slow_colours(const spec::Topology& t);

} // namespace hopmesh::tests
