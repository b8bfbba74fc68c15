#include "sim/reference/block_network.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hopmesh::reference {

BlockNetwork::BlockNetwork(const Network& network, Eigen::Index components, const BlockKernel& kernel)
    : components_(static_cast<std::size_t>(components)), kernel_(kernel) {
  const auto nodes = static_cast<std::size_t>(network.I.size()) / components_;
  bias_.assign(nodes, {});
  magnitude_ = share_ = bias_;
  take(network);
  expect_symmetric(network.W.valuePtr());
}

void BlockNetwork::expect_symmetric(const double* weights) const {
  const double* const block = block_.data()->half[0].lane;
  for (std::size_t k = 0; k < place_.size(); ++k)
    if (std::abs(block[place_[k]] - weights[k]) > 0)
      throw std::logic_error("neurons of two nodes that weigh each other differently");
}

void BlockNetwork::take(const Network& network) {
  if (!has_places_of(network)) lay_out(network);
  refill(network.W.valuePtr(), network.I.data());
}

bool BlockNetwork::has_places_of(const Network& network) const {
  const auto *start = network.W.outerIndexPtr(), *column = network.W.innerIndexPtr();
  return !start_.empty() && std::equal(start_.begin(), start_.end(), start) &&
         std::equal(column_.begin(), column_.end(), column);
}

void BlockNetwork::refill(const double* weights, const double* bias) {
  double* const block = block_.data()->half[0].lane;
  std::size_t neuron = 0;
  for (std::size_t node = 0; node < nodes(); ++node)
    for (std::size_t p = 0; p < components_; ++p, ++neuron) {
      double sum = 0;
      for (auto k = static_cast<std::size_t>(start_[neuron]),
                end = static_cast<std::size_t>(start_[neuron + 1]);
           k < end; ++k) {
        block[place_[k]] = weights[k];
        sum += std::abs(weights[k]);
      }
      const double N = sum + std::abs(bias[neuron]);
      bias_[node].lane[p] = bias[neuron];
      magnitude_[node].lane[p] = sum;
      share_[node].lane[p] = N > 0 ? 1 / N : 0;
    }
}

Quads BlockNetwork::spread(const Vector& V) const {
  Quads quads(static_cast<std::size_t>(V.size()) / components_, Quad{});
  const double* next = V.data();
  for (Quad& quad : quads)
    for (std::size_t p = 0; p < components_; ++p) quad.lane[p] = *next++;
  return quads;
}

Vector BlockNetwork::gathered(const Quads& quads) const {
  Vector V(static_cast<Eigen::Index>(quads.size() * components_));
  double* next = V.data();
  for (const Quad& quad : quads) next = std::copy_n(quad.lane, components_, next);
  return V;
}

// The sources of every node, then where among the figures each weight of the matrix belongs.
void BlockNetwork::lay_out(const Network& network) {
  const auto *start = network.W.outerIndexPtr(), *column = network.W.innerIndexPtr();
  ++layout_;
  start_.assign(start, start + network.I.size() + 1);
  column_.assign(column, column + start_.back());
  place_.assign(column_.size(), 0);
  first_.assign(1, 0);
  source_.clear();
  std::vector<std::uint32_t> block_of(nodes(), 0); // of a source, while a node is looked at
  for (std::size_t node = 0; node < nodes(); ++node) find_sources(node, block_of);
  first_.push_back(first_.back()); // of the one behind the last node
  own_ = source_.size();
  block_.assign(own_ + nodes(), {});
  for (std::size_t node = 0; node < nodes(); ++node) find_places(node, block_of);
}

void BlockNetwork::find_sources(std::size_t node, std::vector<std::uint32_t>& block_of) {
  const std::size_t before = source_.size();
  const auto from = start_[node * components_], to = start_[(node + 1) * components_];
  for (auto k = from; k < to; ++k) {
    const std::size_t source = static_cast<std::size_t>(column_[static_cast<std::size_t>(k)]) / components_;
    if (source == node || block_of[source] != 0) continue;
    source_.push_back(static_cast<std::uint32_t>(source));
    block_of[source] = 1;
  }
  for (std::size_t k = before; k < source_.size(); ++k) block_of[source_[k]] = 0;
  first_.push_back(static_cast<std::uint32_t>(source_.size()));
}

// A block's diagonal, then (xy, yz, zx).
void BlockNetwork::find_places(std::size_t node, std::vector<std::uint32_t>& block_of) {
  constexpr std::uint32_t in_block[3][3] = {{0, 4, 6}, {4, 1, 5}, {6, 5, 2}};
  for (std::uint32_t k = first_[node]; k < first_[node + 1]; ++k) block_of[source_[k]] = k;
  for (std::size_t p = 0; p < components_; ++p) {
    const std::size_t neuron = node * components_ + p;
    for (auto k = static_cast<std::size_t>(start_[neuron]); k < static_cast<std::size_t>(start_[neuron + 1]);
         ++k) {
      const std::size_t source = static_cast<std::size_t>(column_[k]) / components_;
      const std::size_t q = static_cast<std::size_t>(column_[k]) % components_;
      const std::size_t block = source == node ? own_ + node : block_of[source];
      place_[k] = static_cast<std::uint32_t>(8 * block) + in_block[p][q];
    }
  }
  for (std::uint32_t k = first_[node]; k < first_[node + 1]; ++k) block_of[source_[k]] = 0;
}

BlockRows BlockNetwork::rows() const {
  const Quad* const quads = block_.data()->half;
  return {nodes(), components_, first_.data(), source_.data(), quads, quads + 2 * own_};
}

void BlockNetwork::inputs(const Quads& bias, const Quads& V, Quads& s) const {
  kernel_.inputs(rows(), bias.data(), V.data(), s.data());
}

} // namespace hopmesh::reference
