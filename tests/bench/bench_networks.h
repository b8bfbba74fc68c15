// The arrays that Verilog models are built for, by name: one home for what the package writer, the tests and
// the benchmark must agree on.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

#include <string>

namespace hopmesh::bench {

/// An array and the mesh that neuron_modules has built in. time_multiplexed takes any mesh that fits.
struct BenchNetwork {
  spec::ArraySpec array;
  spec::Topology topology;
};

/// "flag": flag-400 on the default array. "small": 5 x 4 free nodes with diagonals, the same array.
/// "planar": 4 x 4 free nodes of two neurons. "narrow": `small` with 16 bits in drive, state and link,
/// rounded toward zero. "byte": the preset of that name with a reciprocal. Throws std::invalid_argument.
BenchNetwork bench_network(const std::string& name);

} // namespace hopmesh::bench
