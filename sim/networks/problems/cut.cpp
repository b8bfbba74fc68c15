// Max-cut: two sides for the nodes of a graph, so that many edges lead from one to the other. Neurons that
// pull each other apart are exactly that.
#include "sim/networks/problems/making.h"

#include <fmt/format.h>

namespace hopmesh::problems {
namespace {

using Edges = std::vector<std::pair<std::size_t, std::size_t>>;

/// `most_cut`: edges of the largest cut, where it is known.
Problem cut_of(std::size_t nodes, Edges edges, std::optional<std::size_t> most_cut, std::uint64_t seed) {
  for (auto& [a, b] : edges)
    if (a > b) std::swap(a, b);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  Problem p;
  p.binary = true;
  Couplings couplings(nodes);
  for (const auto& [a, b] : edges) couplings.add(a, b, -1);
  p.W = couplings.matrix();
  p.bias.assign(nodes, 0);
  Dice dice(seed);
  p.start = random_signs(nodes, dice);
  if (most_cut) p.least_energy = static_cast<double>(edges.size()) - 2 * static_cast<double>(*most_cut);
  p.verdict = [edges](const std::vector<double>& V) {
    const auto cut = std::count_if(edges.begin(), edges.end(),
                                   [&V](const auto& e) { return V[e.first] * V[e.second] < 0; });
    return fmt::format("{} of {} edges cut", cut, edges.size());
  };
  return p;
}

} // namespace

Problem random_cut(std::size_t nodes, double share, std::uint64_t seed) {
  Dice dice(nodes);
  Edges edges;
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (dice.unit() < share) edges.emplace_back(a, b);
  Problem p = cut_of(nodes, edges, {}, seed);
  return p;
}

Problem ring_cut(std::size_t nodes, std::uint64_t seed) {
  Edges edges;
  for (std::size_t a = 0; a < nodes; ++a) edges.emplace_back(a, (a + 1) % nodes);
  Problem p = cut_of(nodes, edges, nodes - nodes % 2, seed);
  return p;
}

Problem torus_cut(std::size_t side, std::uint64_t seed) {
  Edges edges;
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      edges.emplace_back(r * side + c, r * side + (c + 1) % side);
      edges.emplace_back(r * side + c, (r + 1) % side * side + c);
    }
  Problem p = cut_of(side * side, edges, edges.size(), seed);
  return p;
}

Problem bipartite_cut(std::size_t nodes, std::size_t edge_count, std::uint64_t seed) {
  Dice dice(nodes + edge_count);
  const std::vector<double> side = random_signs(nodes, dice);
  Edges edges;
  while (edges.size() < edge_count) {
    const std::size_t a = dice.below(nodes), b = dice.below(nodes);
    if (side[a] == side[b]) continue;
    edges.emplace_back(std::min(a, b), std::max(a, b));
    if (edges.size() < edge_count) continue;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
  Problem p = cut_of(nodes, edges, edge_count, seed);
  return p;
}

} // namespace hopmesh::problems
