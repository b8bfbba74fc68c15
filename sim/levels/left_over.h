// What a step leaves undone: how far its outputs are from the rest of its own network, in double.
#pragma once

#include "firmware/network.h"
#include "rtl_model/spec/array_spec.h"
#include "sim/reference/reference.h"

namespace hopmesh::levels {

/// Largest |s| of the neurons that may still move, over the largest |I|: what s would be if no output had
/// moved from 0. 0 at rest.
double input_left(const hm_mesh& mesh, const hm_network& network);
double input_left(const reference::Network& network, const reference::Vector& V);

/// What the network's energy would still fall by, from V to a rest in double, over the step's whole fall from
/// its start V0. A warm start may begin at rest: then the fall from V0 is a matter of last places, and a
/// thousandth of the fall from outputs of 0 stands for it.
double fall_left(const reference::Network& network, const reference::Vector& V0, const reference::Vector& V,
                 const reference::Order& order, spec::Output output);

} // namespace hopmesh::levels
