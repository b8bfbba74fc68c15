// Colours of cells: linked cells fire at different times. Which colouring it is decides the order of firing,
// so it is a part of what the array is, the same on every machine.
#pragma once

#include "rtl_model/spec/topology.h"

#include <algorithm>
#include <numeric>

namespace hopmesh::spec {

/// A set of numbers below a limit that knows its least: a bit for each number, above them a bit for every
/// word that is not zero, and so on up to one word.
class NumberSet {
 public:
  explicit NumberSet(std::size_t limit) {
    do {
      limit = (limit + 63) / 64;
      layers_.emplace_back(limit, 0);
    } while (limit > 1);
  }
  bool empty() const { return layers_.back().empty() || layers_.back()[0] == 0; }
  void insert(std::size_t number) {
    for (auto& layer : layers_) {
      layer[number / 64] |= std::uint64_t{1} << number % 64;
      number /= 64;
    }
  }
  void erase(std::size_t number) {
    for (auto& layer : layers_) {
      layer[number / 64] &= ~(std::uint64_t{1} << number % 64);
      if (layer[number / 64] != 0) return;
      number /= 64;
    }
  }
  std::size_t least() const { ///< of a set that is not empty
    std::size_t number = 0;
    for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer)
      number = 64 * number + static_cast<std::size_t>(__builtin_ctzll((*layer)[number]));
    return number;
  }

 private:
  std::vector<std::vector<std::uint64_t>> layers_;
};

/// For each cell the colours of its coloured neighbours, a bit a colour; rows grow by a word when 64 are not
/// enough.
class SeenColours {
 public:
  explicit SeenColours(std::size_t cells) : cells_(cells), words_(cells, 0) {}

  std::uint32_t least_free(std::size_t cell) const {
    for (std::size_t w = 0; w < row_; ++w)
      if (const std::uint64_t free = ~words_[cell * row_ + w])
        return static_cast<std::uint32_t>(64 * w + static_cast<std::size_t>(__builtin_ctzll(free)));
    return static_cast<std::uint32_t>(64 * row_);
  }
  /// True if the cell had not seen it before.
  bool add(std::size_t cell, std::uint32_t colour) {
    while (colour >= 64 * row_) widen();
    std::uint64_t& word = words_[cell * row_ + colour / 64];
    const std::uint64_t bit = std::uint64_t{1} << colour % 64;
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

 private:
  void widen() {
    std::vector<std::uint64_t> wider(cells_ * (row_ + 1), 0);
    for (std::size_t c = 0; c < cells_; ++c)
      std::copy_n(words_.begin() + static_cast<std::ptrdiff_t>(c * row_), row_,
                  wider.begin() + static_cast<std::ptrdiff_t>(c * (row_ + 1)));
    words_.swap(wider);
    row_ += 1;
  }

  const std::size_t cells_;
  std::size_t row_ = 1;
  std::vector<std::uint64_t> words_;
};

/// Colours the cells so that no two joined cells share one (DSATUR; ties to the higher degree, then the lower
/// number, so that every machine finds the same colouring). Two colours suffice exactly where the graph is
/// bipartite.
inline std::vector<std::uint32_t> colour_cells(const Topology& t) {
  const std::size_t n = t.cells();
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> order(n), rank(n), colour(n, none), saturation(n, 0);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&t](std::uint32_t a, std::uint32_t b) { return t.degree(a) > t.degree(b); });
  for (std::size_t r = 0; r < n; ++r) rank[order[r]] = static_cast<std::uint32_t>(r);
  SeenColours seen(n);
  std::vector<NumberSet> waiting(1, NumberSet(n)); // by saturation: the ranks of the cells without colour
  for (std::size_t r = 0; r < n; ++r) waiting[0].insert(r);
  for (std::size_t left = n, most = 0; left > 0; --left) {
    while (waiting[most].empty()) --most;
    const std::size_t c = order[waiting[most].least()];
    waiting[most].erase(rank[c]);
    colour[c] = seen.least_free(c);
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k) {
      const std::size_t other = t.link_to[k];
      if (colour[other] != none || !seen.add(other, colour[c])) continue;
      waiting[saturation[other]].erase(rank[other]);
      if (++saturation[other] == waiting.size()) waiting.emplace_back(n);
      waiting[saturation[other]].insert(rank[other]);
      most = std::max<std::size_t>(most, saturation[other]);
    }
  }
  return colour;
}

} // namespace hopmesh::spec
