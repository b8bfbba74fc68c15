// Two fixed levels gave different answers to one network: where, to the sweep, cycle and neuron, and from
// which inputs.
#pragma once

#include "sim/study/array_motion.h"

namespace hopmesh::study {

/// A network as it was loaded: raw codes, and how long to relax.
struct LoadedNetwork {
  std::vector<std::int32_t> weight, bias, start; ///< Topology order
  std::uint32_t threshold = 0, max_sweeps = 1;
};

/// What stands in an array's windows and registers now, with the start that the driver loaded.
LoadedNetwork loaded_network(const hm_bus& bus, const spec::Topology& topology,
                             std::vector<std::int32_t> start);

/// One input of the neuron that first differed.
struct NeuronInput {
  std::uint32_t node, component;
  std::int32_t weight_raw, output_raw; ///< the source's V one update earlier
};

struct FirstDifference {
  std::uint64_t sweep = 0; ///< 1-based, within the step
  std::uint64_t cycle = 0; ///< of the run, in which the neuron published (0: START taken)
  std::uint32_t node = 0, component = 0;
  std::int32_t raw[2] = {0, 0}; ///< V after it, at either level
  std::int32_t before_raw = 0, bias_raw = 0;
  std::vector<NeuronInput> inputs;
};

/// Runs the network on both arrays, one sweep further each time, until their outputs part. Nothing if they
/// never do. Arrays must have been built from the same description, and be idle.
std::optional<FirstDifference> first_difference(const hm_bus& a, const hm_bus& b, const BuiltMesh& mesh,
                                                const spec::ArraySpec& array, const LoadedNetwork& network);

} // namespace hopmesh::study
