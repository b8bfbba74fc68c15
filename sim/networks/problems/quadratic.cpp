// Quadratic functions on a box, the modified network's own problem; convex but for the last two.
#include "sim/networks/problems/making.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::problems {
namespace {

std::string count_at_bounds(const std::vector<double>& V) {
  const auto at = std::count_if(V.begin(), V.end(), [](double v) { return std::abs(v) >= 0.99; });
  return fmt::format("{} of {} outputs within 0.01 of a bound", at, V.size());
}

Problem started_at_zero(Problem p) {
  p.start.assign(p.bias.size(), 0);
  p.verdict = count_at_bounds;
  return p;
}

void couple_at_random(Couplings& couplings, std::size_t neurons, std::size_t degree, Dice& dice,
                      std::vector<double>& row_sum) {
  for (std::size_t k = 0; k < neurons * degree / 2; ++k) {
    const std::size_t i = dice.below(neurons), j = dice.below(neurons);
    if (i == j) continue;
    const double weight = dice.between(-1, 1);
    couplings.add(i, j, weight);
    row_sum[i] += std::abs(weight), row_sum[j] += std::abs(weight);
  }
}

} // namespace

Problem grid_quadratic(std::size_t side, double screen, double load, std::size_t patch) {
  Problem p;
  Couplings couplings(side * side);
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      const std::size_t i = r * side + c;
      couplings.add(i, i, -4 - screen);
      if (c + 1 < side) couplings.add(i, i + 1, 1);
      if (r + 1 < side) couplings.add(i, i + side, 1);
      p.bias.push_back((r / patch + c / patch) % 2 == 0 ? load : -load);
    }
  p.W = couplings.matrix();
  return started_at_zero(std::move(p));
}

Problem random_quadratic(std::size_t neurons, std::size_t degree, double margin) {
  Problem p;
  Dice dice(neurons + degree);
  Couplings couplings(neurons);
  std::vector<double> row_sum(neurons, 0.0);
  couple_at_random(couplings, neurons, degree, dice, row_sum);
  for (std::size_t i = 0; i < neurons; ++i) {
    couplings.add(i, i, -(1 + margin) * row_sum[i] - 0.01);
    p.bias.push_back(dice.between(-1, 1) * 1.5 * row_sum[i]);
  }
  p.W = couplings.matrix();
  return started_at_zero(std::move(p));
}

Problem corner_quadratic(std::size_t neurons) {
  Problem p;
  Dice dice(neurons);
  Couplings couplings(neurons);
  std::vector<double> row_sum(neurons, 0.0);
  couple_at_random(couplings, neurons, neurons / 2, dice, row_sum);
  for (std::size_t i = 0; i < neurons; ++i) {
    couplings.add(i, i, 0.25);
    p.bias.push_back(dice.between(-0.5, 0.5));
  }
  p.W = couplings.matrix();
  return started_at_zero(std::move(p));
}

Problem two_neurons() {
  Problem p;
  Couplings couplings(2);
  couplings.add(0, 1, -1);
  p.W = couplings.matrix();
  p.bias = {0, 0};
  p = started_at_zero(std::move(p));
  p.start = {1, 1};
  p.least_energy = -1;
  return p;
}

} // namespace hopmesh::problems
