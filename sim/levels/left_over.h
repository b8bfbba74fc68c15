// What a step leaves undone: how far its outputs are from the rest of its own network, in double.
#pragma once

#include "sim/levels/built_mesh.h"
#include "sim/reference/block_network.h"

#include <optional>

namespace hopmesh::levels {

/// Largest |s| of the neurons that may still move, over the largest |I|: what s would be if no output had
/// moved from 0. 0 at rest.
double input_left(const hm_mesh& mesh, const hm_network& network);
double input_left(const reference::Network& network, const reference::Vector& V);

/// What the network's energy would still fall by, from V to its rest, over the step's whole fall from the
/// start. A warm start may begin at rest: then the fall from there is a matter of last places, and a
/// thousandth of the fall from outputs of 0 stands for it.
double fall_left(const reference::BlockNetwork& network, const reference::Vector& start,
                 const reference::Vector& V, const reference::Vector& rest);

/// The host's own look at what an array leaves: from the network as the firmware built it, before it was
/// rounded, and the outputs as they were read back.
class LeftOver {
 public:
  /// The look takes some 600 bytes a neuron of the host's memory: larger meshes do without it.
  static constexpr std::size_t most_neurons = 100'000;

  /// A look costs about an eighth of a step of the engine, so a run looks at one step in so many, from the
  /// first on. The step's number alone decides, so that a resumed run looks at the same ones.
  static constexpr std::uint64_t steps_a_look = 8;

  explicit LeftOver(const BuiltMesh& mesh);
  /// Of fall_left(), so much at least where the network is definite. `start`: V0, cell by cell; `sweeps` that
  /// the array took: the look goes so far that it costs a fraction of them.
  double look(const hm_network& network, const std::vector<double>& start, std::uint32_t sweeps);

 private:
  reference::BlockNetwork blocks_; ///< node by node of the array's cells
};

} // namespace hopmesh::levels
