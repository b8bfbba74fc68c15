// What a step leaves undone: how far its outputs are from the rest of its own network, in double.
#pragma once

#include "firmware/network.h"
#include "sim/reference/reference.h"

namespace hopmesh::levels {

/// Largest |s| of the neurons that may still move, over the largest |I|: what s would be if no output had
/// moved from 0. 0 at rest.
double input_left(const hm_mesh& mesh, const hm_network& network);
double input_left(const reference::Network& network, const reference::Vector& V);

/// What the network's energy would still fall by, from V to its rest, over the step's whole fall from the
/// start. A warm start may begin at rest: then the fall from there is a matter of last places, and a
/// thousandth of the fall from outputs of 0 stands for it.
double fall_left(const reference::Network& network, const reference::Vector& start,
                 const reference::Vector& V, const reference::Vector& rest);

} // namespace hopmesh::levels
