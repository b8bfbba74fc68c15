#include "sim/levels/networks/given_network.h"

#include "sim/levels/eigen_vectors.h"

#include <algorithm>
#include <numeric>

namespace hopmesh::levels {

using files::MatrixEntry;
using files::SparseMatrix;

GivenNetwork::GivenNetwork(const NetworkData& data, double start_of_none) {
  const auto n = static_cast<Eigen::Index>(data.W.rows);
  find_links(data.W);
  fill_rows(data.W);
  const std::vector<double> bias = data.bias.empty() ? std::vector<double>(data.W.rows, 0.0) : data.bias;
  network_ = network_of(rows_, bias);
  network_.W.prune(0.0, 0.0);
  start_ = data.start.empty() ? reference::Vector::Constant(n, start_of_none).eval() : vector_of(data.start);
  describe();
}

// The two directions of every coupling, row by row, each once.
void GivenNetwork::find_links(const SparseMatrix& W) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  links.reserve(2 * W.entries.size());
  for (const MatrixEntry& e : W.entries) {
    const auto row = static_cast<std::uint32_t>(e.row), column = static_cast<std::uint32_t>(e.column);
    if (e.value == 0 || row == column) continue;
    links.emplace_back(row, column);
    links.emplace_back(column, row);
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  topology_.neurons_per_cell = 1;
  topology_.first_link.assign(W.rows + 1, 0);
  topology_.link_to.reserve(links.size());
  for (const auto& [from, to] : links) {
    topology_.first_link[from + 1] += 1;
    topology_.link_to.push_back(to);
  }
  std::partial_sum(topology_.first_link.begin(), topology_.first_link.end(), topology_.first_link.begin());
}

// A row is the neuron itself, then its links in ascending order.
void GivenNetwork::fill_rows(const SparseMatrix& W) {
  rows_.assign(topology_.weight_words(), 0.0);
  for (const MatrixEntry& e : W.entries) {
    if (e.value == 0) continue;
    const auto first = topology_.link_to.begin() + topology_.first_link[e.row];
    const auto last = topology_.link_to.begin() + topology_.first_link[e.row + 1];
    const std::size_t tap = e.row == e.column ? 0 : 1 + (std::lower_bound(first, last, e.column) - first);
    rows_[topology_.row_offset(e.row, 0) + tap] = e.value;
  }
}

reference::Network GivenNetwork::network_of(const std::vector<double>& rows,
                                            const std::vector<double>& bias) const {
  const auto n = static_cast<Eigen::Index>(neurons());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(rows.size());
  for (std::size_t c = 0; c < neurons(); ++c) {
    const std::size_t row = topology_.row_offset(c, 0);
    entries.emplace_back(c, c, rows[row]);
    for (std::size_t k = 0; k < topology_.degree(c); ++k)
      entries.emplace_back(c, topology_.link_to[topology_.first_link[c] + k], rows[row + 1 + k]);
  }
  reference::Matrix W(n, n);
  W.setFromTriplets(entries.begin(), entries.end());
  return {W, vector_of(bias)};
}

void GivenNetwork::describe() {
  numbers_.resize(neurons());
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  firmware_.nodes = firmware_.cells = static_cast<std::uint32_t>(neurons());
  firmware_.components = 1;
  firmware_.cell_of_node = firmware_.node_of_cell = numbers_.data();
  firmware_.first_link = topology_.first_link.data();
  firmware_.link_to = topology_.link_to.data();
}

} // namespace hopmesh::levels
