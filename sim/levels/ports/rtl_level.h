// How the level `rtl` is made: a model of the array, from the cache or made now, and a port to it.
#pragma once

#include "sim/levels/array_port.h"

#include <atomic>
#include <memory>

namespace hopmesh::levels {

/// Throws input::InputError for an array that RTL does not cover, or where Verilator is absent. `at_once`:
/// nothing may be built; null where no model is kept, or RTL is not for this array.
std::unique_ptr<ArrayPort> make_rtl_port(const spec::ArraySpec& array, const spec::Topology& topology,
                                         bool at_once, const std::atomic<bool>& stop);
/// A model for networks of usual size, from now on in this process and in the cache.
void make_rtl_model(const spec::ArraySpec& array);

} // namespace hopmesh::levels
