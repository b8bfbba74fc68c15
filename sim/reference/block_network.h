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
  /// `components`: neurons of a node, 1 to 3; 1 suits any network. The block of two nodes is symmetric, as it
  /// is in every mesh. Throws std::logic_error where it is not.
  BlockNetwork(const Network& network, Eigen::Index components, const BlockKernel& kernel = block_kernel());

  /// Another network of as many nodes; much cheaper where its weights have the same places.
  void take(const Network& network);
  /// Other figures in the same places: [weights] in the order of the matrix, and [neurons].
  void refill(const double* weights, const double* bias);

  std::size_t nodes() const { return bias_.size(); }
  const BlockKernel& kernel() const { return kernel_; }
  Quads spread(const Vector& V) const;
  Vector gathered(const Quads& quads) const;

  const Quads& bias() const { return bias_; }
  /// sum_j |W_ij| of every neuron.
  const Quads& magnitude() const { return magnitude_; }

  /// s = W V + bias.
  void inputs(const Quads& bias, const Quads& V, Quads& s) const;

  /// Node by node. Another layout has another number.
  BlockRows rows() const;
  std::uint64_t layout() const { return layout_; }
  /// 1 / N of every neuron; 0 where N is.
  const Quads& share() const { return share_; }

 private:
  using Places = std::vector<Matrix::StorageIndex>;

  void lay_out(const Network& network);
  void find_sources(std::size_t node, std::vector<std::uint32_t>& block_of);
  void find_places(std::size_t node, std::vector<std::uint32_t>& block_of);
  void expect_symmetric(const double* weights) const;
  bool has_places_of(const Network& network) const;

  std::size_t components_;
  const BlockKernel& kernel_;
  Places start_, column_;            ///< of the matrix: where rows begin, and their columns
  std::vector<std::uint32_t> place_; ///< [weights] of the matrix: among the figures of `block_`
  std::vector<std::uint32_t> first_, source_;
  std::vector<QuadPair> block_; ///< those between nodes, then those of the nodes themselves
  std::size_t own_ = 0;         ///< quads before the latter
  std::uint64_t layout_ = 0;
  Quads bias_, magnitude_, share_;
};

} // namespace hopmesh::reference
