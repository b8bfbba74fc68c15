// A network laid out once more, for its neurons to fire in an order: what the fast twin does beside an array,
// sweep by sweep. Nodes that fire together stand four side by side, in the order in which memory gives them.
#pragma once

#include "sim/reference/block_network.h"

namespace hopmesh::reference {

class BlockSweeps {
 public:
  /// Network and order must outlive it.
  BlockSweeps(const BlockNetwork& network, const Order& order);
  BlockSweeps(const BlockSweeps&) = delete;
  BlockSweeps& operator=(const BlockSweeps&) = delete;

  /// The network has other figures: much cheaper where they are in the same places.
  void refill();
  const BlockNetwork& network() const { return network_; }

  /// What relax(network, order, V, 0, sweeps) comes to if nothing rests before.
  Vector swept(const Vector& V, std::uint32_t sweeps) const;

 private:
  /// Some of an order's phases: groups of nodes that share no weight, or a phase whose neurons all read
  /// before any is written.
  struct Stretch {
    std::size_t first = 0, groups = 0;
    const std::vector<std::uint32_t>* together = nullptr;
  };
  void lay_out();
  bool share_nothing(std::size_t phase, std::vector<std::uint32_t>& nodes) const;
  void add_groups(const std::vector<std::uint32_t>& nodes);
  void add_sources(FiringGroup& group);
  void fill(FiringGroup& group, Quad* weight) const;
  void fire_together(const std::vector<std::uint32_t>& phase, Quads& V, Quads& s) const;

  const BlockNetwork& network_;
  const Order& order_;
  const std::size_t components_, figures_; ///< of a node; of a block
  std::uint64_t layout_ = 0;
  std::vector<Stretch> stretches_;
  std::vector<FiringGroup> groups_;
  std::vector<std::uint32_t> source_;
  Quads weight_;
};

} // namespace hopmesh::reference
