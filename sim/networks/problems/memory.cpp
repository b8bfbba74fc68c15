// Associative memory (the paper's eq. 3 and its tradition): patterns stored in W, one recalled from noise.
#include "sim/networks/problems/making.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::problems {
namespace {

constexpr double recalled = 0.95;

/// The first pattern of a memory is a picture: an H in a frame.
double picture(const MemoryPlan& plan, std::size_t row, std::size_t column) {
  const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(plan.rows);
  const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(plan.columns);
  const bool frame = std::min({x, 1 - x, y, 1 - y}) < 0.08;
  const bool post = (x > 0.24 && x < 0.40) || (x > 0.60 && x < 0.76);
  const bool bar = x > 0.24 && x < 0.76 && y > 0.42 && y < 0.58;
  return frame || (y > 0.18 && y < 0.82 && (post || bar)) ? 1 : -1;
}

std::vector<std::vector<double>> patterns_of(const MemoryPlan& plan) {
  const std::size_t n = plan.rows * plan.columns;
  Dice dice(n);
  std::vector<std::vector<double>> all(plan.patterns);
  for (auto& pattern : all) pattern = random_signs(n, dice);
  for (std::size_t i = 0; i < n; ++i) all[0][i] = picture(plan, i / plan.columns, i % plan.columns);
  return all;
}

double overlap(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

/// Rows of Q^-1 X for patterns X and their overlaps Q (Gauss and Jordan; overlaps of few random patterns are
/// near the unit matrix, so no row need be exchanged).
std::vector<std::vector<double>> dual_patterns(const std::vector<std::vector<double>>& patterns) {
  const std::size_t m = patterns.size();
  auto dual = patterns;
  std::vector<std::vector<double>> Q(m, std::vector<double>(m));
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t b = 0; b < m; ++b) Q[a][b] = overlap(patterns[a], patterns[b]);
  for (std::size_t a = 0; a < m; ++a) {
    const double pivot = Q[a][a];
    for (double& q : Q[a]) q /= pivot;
    for (double& x : dual[a]) x /= pivot;
    for (std::size_t b = 0; b < m; ++b) {
      const double factor = Q[b][a];
      if (b == a || factor == 0) continue;
      for (std::size_t k = 0; k < m; ++k) Q[b][k] -= factor * Q[a][k];
      for (std::size_t i = 0; i < dual[a].size(); ++i) dual[b][i] -= factor * dual[a][i];
    }
  }
  return dual;
}

/// The lower half is summed, the upper copied: symmetric to the last bit, whatever the sums lost.
files::SparseMatrix stored(const std::vector<std::vector<double>>& patterns, bool projection) {
  const auto dual = projection ? dual_patterns(patterns) : patterns;
  const std::size_t n = patterns[0].size();
  std::vector<double> W(n * n, 0.0);
  for (std::size_t k = 0; k < patterns.size(); ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) W[i * n + j] += patterns[k][i] * dual[k][j];
  files::SparseMatrix matrix{n, n, {}};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double weight = W[std::max(i, j) * n + std::min(i, j)] / static_cast<double>(n);
      if (i != j && weight != 0) matrix.entries.push_back({i, j, weight});
    }
  return matrix;
}

} // namespace

std::vector<double> memory_pattern(const MemoryPlan& plan, std::uint64_t seed) {
  return patterns_of(plan)[(seed - 1) % plan.patterns];
}

Problem memory(const MemoryPlan& plan, std::uint64_t seed) {
  const auto patterns = patterns_of(plan);
  const std::vector<double> pattern = patterns[(seed - 1) % plan.patterns];
  Problem p;
  p.binary = true;
  p.W = stored(patterns, plan.projection);
  p.bias.assign(pattern.size(), 0);
  p.start = pattern;
  Dice dice(seed);
  for (double& v : p.start)
    if (dice.unit() < plan.noise) v = -v;
  p.verdict = [pattern](const std::vector<double>& V) {
    const double m = overlap(pattern, V);
    return fmt::format("overlap with the pattern {:.3f}: {}", m, m >= recalled ? "recalled" : "not recalled");
  };
  return p;
}

} // namespace hopmesh::problems
