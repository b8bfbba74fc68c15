#include "tests/support/slow_colouring.h"

#include <set>
#include <tuple>

namespace hopmesh::tests {

std::vector<std::uint32_t> slow_colours(const spec::Topology& t) {
  const std::size_t n = t.cells();
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> colour(n, none);
  std::vector<std::set<std::uint32_t>> seen(n);
  using Key = std::tuple<long, long, std::size_t>;
  const auto key = [&](std::size_t c) { return Key{-long(seen[c].size()), -long(t.degree(c)), c}; };
  std::set<Key> waiting;
  for (std::size_t c = 0; c < n; ++c) waiting.insert(key(c));
  while (!waiting.empty()) {
    const std::size_t c = std::get<2>(*waiting.begin());
    waiting.erase(waiting.begin());
    std::uint32_t free_colour = 0;
    while (seen[c].count(free_colour)) ++free_colour;
    colour[c] = free_colour;
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k) {
      const std::size_t other = t.link_to[k];
      if (colour[other] != none || seen[other].count(free_colour)) continue;
      waiting.erase(key(other));
      seen[other].insert(free_colour);
      waiting.insert(key(other));
    }
  }
  return colour;
}

} // namespace hopmesh::tests
