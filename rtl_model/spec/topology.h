// Which cells there are and which links join them. In a mesh, cells stand only for free nodes and links only
// for springs between two free nodes; any other network is cells of one neuron each, linked where either of
// two weighs the other. Row layout of the weight memory follows from it and is used by every model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopmesh::spec {

/// The array's graph. Links are stored as compressed rows: cell c is joined to
/// link_to[first_link[c]] ... link_to[first_link[c + 1] - 1], in ascending order, symmetric, without itself.
struct Topology {
  int neurons_per_cell = 3;              ///< 3; 2 in a planar scene; 1 in a network that is no mesh
  std::vector<std::uint32_t> first_link; ///< cells + 1 entries
  std::vector<std::uint32_t> link_to;    ///< two entries per link

  std::size_t cells() const { return first_link.empty() ? 0 : first_link.size() - 1; }
  std::size_t neurons() const { return cells() * neurons_per_cell; }
  std::size_t links() const { return link_to.size() / 2; }
  std::size_t degree(std::size_t cell) const { return first_link[cell + 1] - first_link[cell]; }
  /// Inputs of one neuron of this cell: the cell's own neurons first, then each neighbour's, link by link.
  std::size_t taps(std::size_t cell) const { return neurons_per_cell * (1 + degree(cell)); }
  /// First word of the row of neuron p of this cell in the weight memory; its length is taps(cell).
  std::size_t row_offset(std::size_t cell, std::size_t p) const {
    const std::size_t blocks_before = cell + first_link[cell];
    return neurons_per_cell * neurons_per_cell * blocks_before + p * taps(cell);
  }
  std::size_t weight_words() const {
    return neurons_per_cell * neurons_per_cell * (cells() + link_to.size());
  }
  std::size_t most_taps() const {
    std::size_t most = 0;
    for (std::size_t c = 0; c < cells(); ++c)
      if (taps(c) > most) most = taps(c);
    return most;
  }
};

} // namespace hopmesh::spec
