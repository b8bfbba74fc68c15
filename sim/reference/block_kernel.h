// The inner loops of the fast twin of the reference, compiled for several instruction sets; the processor
// decides at run time. All give the same bits: they share every operation and its order (sums run in four
// lanes, which are added in the end).
#pragma once

#include <cstddef>
#include <cstdint>

namespace hopmesh::reference {

/// A figure for each neuron of a node; a node has at most three, and what is over stays 0.
struct alignas(32) Quad {
  double lane[4];
};

/// A network node by node. Nodes that share weights share a block of them, column by column: what an output
/// of the source does to all neurons of the node.
struct BlockRows {
  std::size_t nodes = 0, components = 0;
  const std::uint32_t* first = nullptr;  ///< [nodes + 1] of a node's blocks
  const std::uint32_t* source = nullptr; ///< [blocks] the node that a block reads, never the node itself
  const Quad* weight = nullptr;          ///< [blocks * components]
  const Quad* own = nullptr;             ///< [nodes * components] weights between the node's own neurons
  const Quad* share = nullptr;           ///< [nodes] 1 / N, with N of paper eq. 9; 0 where N is
};

/// How a descent stands. Steps are of s_i / sum_j |W_ij|.
struct Standing {
  double free_slope = 0;   ///< sum of s times its step over outputs between the bounds
  double inward_slope = 0; ///< and over those at a bound that want away from it
  double violation = 0;    ///< the largest step that the box leaves
  bool inside = false;     ///< what moved stays between the bounds
};

/// A descent's figures, [nodes] each.
struct DescentFields {
  const Quad* reach = nullptr; ///< sum_j |W_ij|
  const Quad* step = nullptr;  ///< 1 / reach
  const Quad *V = nullptr, *s = nullptr, *direction = nullptr;
  const Quad* change = nullptr; ///< W times the direction
};

struct BlockKernel {
  const char* name;
  /// s = W V + bias, all [nodes].
  void (*inputs)(const BlockRows& rows, const Quad* bias, const Quad* V, Quad* s);
  /// Fires the neurons of the nodes named, which share no weight, component by component.
  void (*sweep)(const BlockRows& rows, const Quad* bias, const std::uint32_t* node, std::size_t count,
                Quad* V);

  /// direction = step * free + kept * direction.
  void (*turn)(std::size_t nodes, const Quad* step, const Quad* free, double kept, Quad* direction);
  /// -direction' W direction, and the most that the weights allow for it.
  void (*bend)(std::size_t nodes, const DescentFields& at, double& curvature, double& most);
  /// Walks so far along the direction: V and s there, s of outputs between the bounds, and how that stands.
  Standing (*walk)(std::size_t nodes, const DescentFields& from, double far, Quad* V, Quad* s, Quad* free);
};

extern const BlockKernel portable_kernel, avx2_kernel;
/// The widest that this processor runs.
const BlockKernel& block_kernel();

} // namespace hopmesh::reference
