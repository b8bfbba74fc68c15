// Two fixed levels gave different answers to one network: where, to the sweep, cycle and node, and from which
// inputs.
#pragma once

#include "sim/cosim/lockstep.h"
#include "sim/levels/array_mover.h"

namespace hopmesh::cosim {

/// An input of the neuron that first differed.
struct NeuronInput {
  std::uint32_t node, component;
  std::int32_t weight_raw, output_raw; ///< the source's V one update earlier
};

struct FirstDifference {
  std::uint64_t sweep = 0; ///< 1-based, within the run
  std::uint64_t cycle = 0; ///< of the run, in which the neuron published (0: START taken)
  std::uint64_t sweep_cycles = 0;
  std::uint32_t cell = 0, node = 0, component = 0;
  std::int32_t raw[2] = {0, 0}; ///< V after it, at either level
  std::int32_t before_raw = 0, bias_raw = 0;
  std::vector<NeuronInput> inputs;
  bool ahead = false; ///< the inputs saw Y, ahead of the V that is told
};

/// The divergence in the mesh's words: nodes for cells.
FirstDifference in_mesh(const Divergence& divergence, const levels::BuiltMesh& mesh, const ArrayJob& job);

/// Where two arrays part on a job that both have loaded: sweep by sweep, then, if that shows nothing, by
/// longer and longer runs. Nothing if they never do. The arrays must be idle.
std::optional<FirstDifference> first_difference(const Arrays& two, const levels::BuiltMesh& mesh,
                                                const ArrayJob& job, std::uint32_t sweeps);

/// Several lines: sweep, cycle, node, neuron, both codes, and every input one update earlier.
std::string text_of(const FirstDifference& difference, const std::string& a, const std::string& b);

} // namespace hopmesh::cosim
