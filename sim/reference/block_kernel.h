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

/// A whole line of the cache.
struct alignas(64) QuadPair {
  Quad half[2];
};

/// A network node by node. Nodes that share weights share a symmetric block of them: what the outputs of the
/// source do to the neurons of the node. A block lies as its diagonal and as (xy, yz, zx).
struct BlockRows {
  std::size_t nodes = 0, components = 0;
  const std::uint32_t* first =
      nullptr; ///< [nodes + 2] of a node's blocks; behind the last node is one without
  const std::uint32_t* source = nullptr; ///< [blocks] the node that a block reads, never the node itself
  const Quad* weight = nullptr;          ///< [blocks][2]
  const Quad* own = nullptr;             ///< [nodes][2] weights between the node's own neurons
};

/// Four nodes that fire together and share no weight; a figure for each of them in the lanes of a quad. Where
/// nodes run out the one behind the last stands in, whose output stays 0; so it does for the sources of a
/// node that has fewer than the others.
struct FiringGroup {
  std::uint32_t node[4];
  std::uint32_t sources;       ///< of each of them
  const std::uint32_t* source; ///< [sources][4]
  const Quad* weight; ///< [sources][n (n + 1) / 2] of n components: xx, yy, zz, xy, yz, zx; xx, yy, xy; xx
  Quad own[3][3];     ///< the weight of an output q in a neuron p
  Quad share[3];      ///< 1 / N, with N of paper eq. 9; 0 where N is
  Quad bias[3];
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
  /// Fires the groups, none of whose nodes share weights, component by component. V: [nodes + 1].
  void (*sweep)(std::size_t components, const FiringGroup* group, std::size_t count, Quad* V);

  /// direction = step * free + kept * direction.
  void (*turn)(std::size_t nodes, const Quad* step, const Quad* free, double kept, Quad* direction);
  /// -direction' W direction, and the most that the weights allow for it.
  void (*bend)(std::size_t nodes, const DescentFields& at, double& curvature, double& most);
  /// Walks so far along the direction: V and s there, s of outputs between the bounds, and how that stands.
  Standing (*walk)(std::size_t nodes, const DescentFields& from, double far, Quad* V, Quad* s, Quad* free);
};

extern const BlockKernel portable_kernel, avx2_kernel, avx512_kernel;
/// The widest that this processor runs.
const BlockKernel& block_kernel();

} // namespace hopmesh::reference
