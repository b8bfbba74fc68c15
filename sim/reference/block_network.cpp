#include "sim/reference/block_network.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {

BlockNetwork::BlockNetwork(const Network& network, Eigen::Index components, const BlockKernel& kernel)
    : components_(static_cast<std::size_t>(components)), kernel_(kernel) {
  const auto nodes = static_cast<std::size_t>(network.I.size()) / components_;
  bias_ = spread(network.I);
  magnitude_.assign(nodes, {});
  share_.assign(nodes, {});
  own_.assign(nodes * components_, {});
  lay_out(network);
  for (std::size_t node = 0; node < nodes; ++node)
    for (std::size_t p = 0; p < components_; ++p) {
      const double N = magnitude_[node].lane[p] + std::abs(bias_[node].lane[p]);
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

void BlockNetwork::lay_out(const Network& network) {
  const auto weights = static_cast<std::size_t>(network.W.nonZeros());
  source_.reserve(weights / (components_ * components_));
  weight_.reserve(weights / components_);
  first_.assign(1, 0);
  place_.assign(bias_.size(), 0);
  for (std::size_t node = 0; node < bias_.size(); ++node) {
    for (std::size_t p = 0; p < components_; ++p) add_row(network, node, p);
    for (std::size_t k = first_.back(); k < source_.size(); ++k) place_[source_[k]] = 0;
    first_.push_back(static_cast<std::uint32_t>(source_.size()));
  }
}

// Columns ascend, so that those of a block follow each other.
void BlockNetwork::add_row(const Network& network, std::size_t node, std::size_t p) {
  const auto row = static_cast<Eigen::Index>(node * components_ + p);
  const auto *column = network.W.innerIndexPtr(), *start = network.W.outerIndexPtr();
  const double* weight = network.W.valuePtr();
  std::size_t from = 0, end = 0; // columns of the block at hand
  Quad* block = nullptr;
  double sum = 0;
  for (auto k = start[row]; k < start[row + 1]; ++k) {
    const auto at = static_cast<std::size_t>(column[k]);
    if (at >= end || at < from) {
      const std::size_t source = at / components_;
      from = source * components_, end = from + components_;
      block = source == node ? &own_[from] : &weight_[block_of(static_cast<std::uint32_t>(source))];
    }
    block[at - from].lane[p] = weight[k];
    sum += std::abs(weight[k]);
  }
  magnitude_[node].lane[p] = sum;
}

std::size_t BlockNetwork::block_of(std::uint32_t source) {
  if (place_[source] == 0) {
    source_.push_back(source);
    weight_.resize(weight_.size() + components_, Quad{});
    place_[source] = static_cast<std::uint32_t>(source_.size());
  }
  return (place_[source] - 1) * components_;
}

BlockRows BlockNetwork::rows() const {
  return {nodes(), components_, first_.data(), source_.data(), weight_.data(), own_.data(), share_.data()};
}

void BlockNetwork::inputs(const Quads& bias, const Quads& V, Quads& s) const {
  kernel_.inputs(rows(), bias.data(), V.data(), s.data());
}

// Phases from this one on that fire all neurons of some nodes, component by component, where the nodes share
// no weight: then each phase need not read all it needs before it writes.
bool BlockNetwork::share_nothing(const Order& order, std::size_t phase,
                                 std::vector<std::uint32_t>& nodes) const {
  const auto n = static_cast<std::uint32_t>(components_);
  if (phase + n > order.size()) return false;
  for (std::uint32_t p = 0; p < n; ++p)
    if (order[phase + p].size() != order[phase].size()) return false;
  std::vector<bool> fires(bias_.size(), false);
  for (std::size_t k = 0; k < order[phase].size(); ++k) {
    const std::uint32_t node = order[phase][k] / n;
    for (std::uint32_t p = 0; p < n; ++p)
      if (order[phase + p][k] != node * n + p) return false;
    nodes.push_back(node);
    fires[node] = true;
  }
  for (const std::uint32_t node : nodes)
    for (std::uint32_t k = first_[node]; k < first_[node + 1]; ++k)
      if (fires[source_[k]]) return false;
  return true;
}

std::vector<BlockNetwork::Stretch> BlockNetwork::stretches(const Order& order) const {
  std::vector<Stretch> all;
  for (std::size_t phase = 0; phase < order.size();) {
    std::vector<std::uint32_t> nodes;
    if (!share_nothing(order, phase, nodes)) {
      all.push_back({{}, &order[phase++]});
      continue;
    }
    all.push_back({std::move(nodes), nullptr});
    phase += components_;
  }
  return all;
}

void BlockNetwork::fire_together(const std::vector<std::uint32_t>& phase, Quads& V, Quads& s) const {
  inputs(bias_, V, s);
  for (const std::uint32_t neuron : phase) {
    const std::size_t node = neuron / components_, p = neuron % components_;
    double& v = V[node].lane[p];
    const double u = s[node].lane[p] * share_[node].lane[p];
    v += u - v * std::abs(u);
  }
}

// Sums here are not in the order of N's, and may leave the box by a last place.
Vector BlockNetwork::swept(const Order& order, const Vector& V, std::uint32_t sweeps) const {
  const std::vector<Stretch> all = stretches(order);
  Quads now = spread(V), s(now.size(), Quad{});
  for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep)
    for (const Stretch& stretch : all)
      if (stretch.together)
        fire_together(*stretch.together, now, s);
      else
        kernel_.sweep(rows(), bias_.data(), stretch.nodes.data(), stretch.nodes.size(), now.data());
  return gathered(now).cwiseMin(1).cwiseMax(-1);
}

} // namespace hopmesh::reference
