// The description of an array as a SystemVerilog package: what rtl_model/spec says, where Verilog can read
// it.
#pragma once

#include "rtl_model/spec/schedule.h"

#include <string>

namespace hopmesh::bench {

/// What a time_multiplexed model has room for, at least.
struct Capacity {
  std::size_t phases = 0, elements = 0, taps = 0;
};

/// The package `array_pkg`. Throws std::invalid_argument for an array that the Verilog models do not know:
/// they have one lane, a reciprocal, an exact accumulator, and numbers of at most 64 bits on the way.
std::string array_package(const spec::ArraySpec& array, const spec::Topology& topology, Capacity capacity);

} // namespace hopmesh::bench
