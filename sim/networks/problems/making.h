// What the makers of problems share: dice that fall the same way everywhere, and W filled pair by pair.
#pragma once

#include "sim/networks/problems/problem.h"

#include <algorithm>

namespace hopmesh::problems {

/// SplitMix64: the same numbers on every machine, which std::uniform_real_distribution does not promise.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; } ///< [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  double sign() { return next() >> 63 ? 1.0 : -1.0; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

 private:
  std::uint64_t state_;
};

/// Weights of pairs and of neurons on themselves; what is added twice adds up.
class Couplings {
 public:
  explicit Couplings(std::size_t neurons) : neurons_(neurons) {}

  void add(std::size_t i, std::size_t j, double weight) {
    entries_.push_back({i, j, weight});
    if (i != j) entries_.push_back({j, i, weight});
  }
  files::SparseMatrix matrix() {
    std::stable_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
      return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    files::SparseMatrix W{neurons_, neurons_, {}};
    for (const files::MatrixEntry& e : entries_)
      if (!W.entries.empty() && W.entries.back().row == e.row && W.entries.back().column == e.column)
        W.entries.back().value += e.value;
      else
        W.entries.push_back(e);
    return W;
  }

 private:
  std::size_t neurons_;
  std::vector<files::MatrixEntry> entries_;
};

inline std::vector<double> random_signs(std::size_t n, Dice& dice) {
  std::vector<double> V(n);
  for (double& v : V) v = dice.sign();
  return V;
}

// A maker for each family; the numbers are in problem.cpp.

/// Hebb: W = 1/n sum of outer products; `projection`: W projects onto what the patterns span. Diagonal 0.
struct MemoryPlan {
  std::size_t rows, columns, patterns;
  double noise; ///< share of the pattern's signs that the start has turned
  bool projection;
};
Problem memory(const MemoryPlan& plan, std::uint64_t seed);
std::vector<double> memory_pattern(const MemoryPlan& plan, std::uint64_t seed);

/// Max-cut: W = -1 for every edge, no bias: E = edges not cut - edges cut.
Problem random_cut(std::size_t nodes, double share, std::uint64_t seed);
Problem ring_cut(std::size_t nodes, std::uint64_t seed);
Problem torus_cut(std::size_t side, std::uint64_t seed);
Problem bipartite_cut(std::size_t nodes, std::size_t edges, std::uint64_t seed);

Problem queens(std::size_t n, std::uint64_t seed);

/// Grid Laplacian with `screen` on its diagonal, pushed up and down patch by patch by a load that is strong
/// enough for bounds to count.
Problem grid_quadratic(std::size_t side, double screen, double load, std::size_t patch);
/// About `degree` random couplings a neuron; `margin`: W_ii = -(1 + margin) sum |W_ij|.
Problem random_quadratic(std::size_t neurons, std::size_t degree, double margin);
/// Diagonal above 0: the least energy is at a corner.
Problem corner_quadratic(std::size_t neurons);
/// Two neurons that turn each other: flips for ever where both fire at once.
Problem two_neurons();

} // namespace hopmesh::problems
