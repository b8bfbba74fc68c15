// A network laid out for speed: the fast twin of the readable reference (reference.h, relaxation.cpp), which
// judges it (tests/reference/test_block_network.cpp). Sums run in another order than there, so that the two
// agree but for rounding.
#pragma once

#include "sim/reference/block_kernel.h"
#include "sim/reference/reference.h"

#include <vector>

namespace hopmesh::reference {

/// A figure for each neuron, node by node.
using Quads = std::vector<Quad>;

class BlockNetwork {
 public:
  /// `components`: neurons of a node, 1 to 3; 1 suits any network.
  BlockNetwork(const Network& network, Eigen::Index components, const BlockKernel& kernel = block_kernel());

  std::size_t nodes() const { return bias_.size(); }
  const BlockKernel& kernel() const { return kernel_; }
  Quads spread(const Vector& V) const;
  Vector gathered(const Quads& quads) const;

  const Quads& bias() const { return bias_; }
  /// sum_j |W_ij| of every neuron.
  const Quads& magnitude() const { return magnitude_; }

  /// s = W V + bias.
  void inputs(const Quads& bias, const Quads& V, Quads& s) const;
  /// What relax(network, order, V, 0, sweeps) comes to if nothing rests before.
  Vector swept(const Order& order, const Vector& V, std::uint32_t sweeps) const;

 private:
  /// Some of an order's phases: those of nodes that share no weight, or a phase whose neurons all read before
  /// any is written.
  struct Stretch {
    std::vector<std::uint32_t> nodes;
    const std::vector<std::uint32_t>* together = nullptr;
  };
  void lay_out(const Network& network);
  void add_row(const Network& network, std::size_t node, std::size_t p);
  std::size_t block_of(std::uint32_t source);
  BlockRows rows() const;
  bool share_nothing(const Order& order, std::size_t phase, std::vector<std::uint32_t>& nodes) const;
  std::vector<Stretch> stretches(const Order& order) const;
  void fire_together(const std::vector<std::uint32_t>& phase, Quads& V, Quads& s) const;

  std::size_t components_;
  const BlockKernel& kernel_;
  std::vector<std::uint32_t> first_, source_;
  std::vector<std::uint32_t> place_; ///< while a node is laid out: 1 + the block of a source
  Quads weight_, own_, bias_, magnitude_, share_;
};

} // namespace hopmesh::reference
