#include "sim/reference/block_sweeps.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {
namespace {

/// Where a block, eight figures, has those that a group of n components keeps: its diagonal, then (xy, yz,
/// zx).
constexpr std::size_t kept[3][6] = {{0}, {0, 1, 4}, {0, 1, 2, 4, 5, 6}};

/// And where the weight of an output q in a neuron p is.
constexpr std::size_t in_block[3][3] = {{0, 4, 6}, {4, 1, 5}, {6, 5, 2}};

} // namespace

BlockSweeps::BlockSweeps(const BlockNetwork& network, const Order& order)
    : network_(network), order_(order), components_(network.rows().components),
      figures_(components_ * (components_ + 1) / 2) {
  refill();
}

void BlockSweeps::refill() {
  if (layout_ != network_.layout()) lay_out();
  Quad* weight = weight_.data();
  const std::uint32_t* source = source_.data();
  for (FiringGroup& group : groups_) {
    group.source = source;
    group.weight = weight;
    fill(group, weight);
    source += std::size_t{4} * group.sources;
    weight += figures_ * group.sources;
  }
}

void BlockSweeps::lay_out() {
  layout_ = network_.layout();
  stretches_.clear();
  groups_.clear();
  source_.clear();
  for (std::size_t phase = 0; phase < order_.size();) {
    std::vector<std::uint32_t> nodes;
    if (!share_nothing(phase, nodes)) {
      stretches_.push_back({0, 0, &order_[phase++]});
      continue;
    }
    const std::size_t first = groups_.size();
    add_groups(nodes);
    stretches_.push_back({first, groups_.size() - first, nullptr});
    phase += components_;
  }
  weight_.assign(source_.size() / 4 * figures_, Quad{});
}

// Phases from this one on that fire all neurons of some nodes, component by component, where the nodes share
// no weight: then each phase need not read all it needs before it writes.
bool BlockSweeps::share_nothing(std::size_t phase, std::vector<std::uint32_t>& nodes) const {
  const auto n = static_cast<std::uint32_t>(components_);
  if (phase + n > order_.size()) return false;
  for (std::uint32_t p = 0; p < n; ++p)
    if (order_[phase + p].size() != order_[phase].size()) return false;
  std::vector<bool> fires(network_.nodes(), false);
  for (std::size_t k = 0; k < order_[phase].size(); ++k) {
    const std::uint32_t node = order_[phase][k] / n;
    for (std::uint32_t p = 0; p < n; ++p)
      if (order_[phase + p][k] != node * n + p) return false;
    nodes.push_back(node);
    fires[node] = true;
  }
  const BlockRows rows = network_.rows();
  for (const std::uint32_t node : nodes)
    for (std::uint32_t k = rows.first[node]; k < rows.first[node + 1]; ++k)
      if (fires[rows.source[k]]) return false;
  return true;
}

void BlockSweeps::add_groups(const std::vector<std::uint32_t>& nodes) {
  for (std::size_t k = 0; k < nodes.size(); k += 4) {
    FiringGroup group{};
    for (std::size_t lane = 0; lane < 4; ++lane)
      group.node[lane] =
          k + lane < nodes.size() ? nodes[k + lane] : static_cast<std::uint32_t>(network_.nodes());
    add_sources(group);
    groups_.push_back(group);
  }
}

void BlockSweeps::add_sources(FiringGroup& group) {
  const BlockRows rows = network_.rows();
  for (const std::uint32_t node : group.node)
    group.sources = std::max(group.sources, rows.first[node + 1] - rows.first[node]);
  for (std::uint32_t k = 0; k < group.sources; ++k)
    for (const std::uint32_t node : group.node) {
      const std::uint32_t at = rows.first[node] + k;
      source_.push_back(at < rows.first[node + 1] ? rows.source[at]
                                                  : static_cast<std::uint32_t>(network_.nodes()));
    }
}

void BlockSweeps::fill(FiringGroup& group, Quad* weight) const {
  const BlockRows rows = network_.rows();
  const std::size_t* const places = kept[components_ - 1];
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::size_t node = group.node[lane];
    if (node == network_.nodes()) continue;
    Quad* to = weight;
    for (std::size_t k = rows.first[node]; k < rows.first[node + 1]; ++k, to += figures_) {
      const double* const block = rows.weight[2 * k].lane;
      for (std::size_t figure = 0; figure < figures_; ++figure) to[figure].lane[lane] = block[places[figure]];
    }
    const double* const own = rows.own[2 * node].lane;
    for (std::size_t p = 0; p < components_; ++p) {
      group.share[p].lane[lane] = network_.share()[node].lane[p];
      group.bias[p].lane[lane] = network_.bias()[node].lane[p];
      for (std::size_t q = 0; q < components_; ++q) group.own[p][q].lane[lane] = own[in_block[p][q]];
    }
  }
}

void BlockSweeps::fire_together(const std::vector<std::uint32_t>& phase, Quads& V, Quads& s) const {
  network_.inputs(network_.bias(), V, s);
  for (const std::uint32_t neuron : phase) {
    const std::size_t node = neuron / components_, p = neuron % components_;
    double& v = V[node].lane[p];
    const double u = s[node].lane[p] * network_.share()[node].lane[p];
    v += u - v * std::abs(u);
  }
}

// Sums here are not in the order of N's, and may leave the box by a last place.
Vector BlockSweeps::swept(const Vector& V, std::uint32_t sweeps) const {
  Quads now = network_.spread(V), s(now.size(), Quad{});
  now.push_back(Quad{}); // the one behind the last node
  for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep)
    for (const Stretch& stretch : stretches_)
      if (stretch.together)
        fire_together(*stretch.together, now, s);
      else
        network_.kernel().sweep(components_, groups_.data() + stretch.first, stretch.groups, now.data());
  now.pop_back();
  return network_.gathered(now).cwiseMin(1).cwiseMax(-1);
}

} // namespace hopmesh::reference
