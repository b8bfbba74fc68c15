// Where everything of an array lies for the kernels: weights, and the way to each neighbour's outputs. Made
// once for a mesh; kernel.h says how it is read.
#pragma once

#include "sim/engine/kernels/kernel.h"
#include "sim/engine/layout.h"

#include <vector>

namespace hopmesh::engine {

class FastLayout {
 public:
  /// `in_order`: cells lie by number, as where all fire at once.
  FastLayout(const Layout& layout, std::size_t per_cell, bool in_order);

  /// Index of a neuron's bias, state and multiplier.
  std::size_t place(std::size_t slot, std::size_t p) const {
    return (slot / block_lanes * per_cell_ + p) * block_lanes + slot % block_lanes;
  }
  /// Where the row of a neuron begins among the weights, in pairs of 16-bit codes.
  std::size_t row(std::size_t slot, std::size_t p) const {
    return first_weight[slot / block_lanes] + p * block_lanes + slot % block_lanes;
  }
  /// Where a tap stands in its row, in codes.
  std::size_t in_row(std::size_t slot, std::size_t tap) const {
    const std::size_t input = tap / per_cell_, q = tap % per_cell_;
    const std::size_t at = input == 0 ? 0 : 1 + column[first_column[slot] + input - 1];
    return tap_place[neighbours[slot / block_lanes]][at * per_cell_ + q];
  }

  std::vector<std::uint32_t> neighbours;   ///< [blocks] for which each lane of the block has room
  std::vector<std::uint32_t> first_column; ///< of each slot, in `column`
  std::vector<std::uint16_t> column;       ///< of its block, in which the k-th neighbour of a cell stands
  std::vector<std::vector<std::uint32_t>> tap_place; ///< by neighbours of a block: place of a tap in its row
  std::vector<std::size_t> first_weight;             ///< [blocks + 1]
  std::vector<std::uint32_t> first_source, far_slot;
  std::vector<Source> source;
  std::vector<std::uint8_t> waits; ///< [blocks] does the block read what one of the two before it writes?

 private:
  std::size_t pairs(std::size_t n) const {
    return per_cell_ == 3 ? 2 + n + n / 2 : per_cell_ == 2 ? 1 + n : 1 + n / 2;
  }
  std::uint32_t degree(std::size_t slot) const { return layout_.degree[slot]; }
  std::uint32_t neighbour(std::size_t slot, std::size_t k) const;
  std::int64_t way(std::size_t slot, std::size_t k) const;
  void align_neighbours();
  void lay_out_weights();
  void find_sources();
  void add_source(std::size_t block, const std::uint32_t* slots);
  bool reads_the_two_before(std::size_t block) const;

  const Layout& layout_;
  const std::size_t per_cell_;
  const bool in_order_;
};

} // namespace hopmesh::engine
