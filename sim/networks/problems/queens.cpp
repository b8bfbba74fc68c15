// n queens: a neuron a square, +1 for a queen. With x = (1 + V) / 2,
//   sum over rows and columns of (sum x - 1)^2 + 2 for each pair on a diagonal
// is 0 for a solution and above 0 at all other corners. W_ii = 0: on the whole box it is least at corners
// too, and outputs that start near 0 find a solution far more often than signs do.
#include "sim/networks/problems/making.h"

#include <fmt/format.h>

namespace hopmesh::problems {
namespace {

bool attack(std::size_t n, std::size_t a, std::size_t b) {
  const auto row = [n](std::size_t s) { return static_cast<std::ptrdiff_t>(s / n); };
  const auto column = [n](std::size_t s) { return static_cast<std::ptrdiff_t>(s % n); };
  const std::ptrdiff_t down = row(a) - row(b), right = column(a) - column(b);
  return down == 0 || right == 0 || down == right || down == -right;
}

std::string judge(std::size_t n, const std::vector<double>& V) {
  std::vector<std::size_t> queens;
  for (std::size_t s = 0; s < V.size(); ++s)
    if (V[s] > 0) queens.push_back(s);
  std::size_t attacks = 0;
  for (std::size_t a = 0; a < queens.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) attacks += attack(n, queens[a], queens[b]);
  return fmt::format("{} queens, {} attacks: {}", queens.size(), attacks,
                     queens.size() == n && attacks == 0 ? "a solution" : "no solution");
}

} // namespace

// Every pair that attacks costs 2 x x' (of a row: 2 sum of pairs = (sum x)^2 - sum x), every queen gains 1
// for its row and 1 for its column.
Problem queens(std::size_t n, std::uint64_t seed) {
  const std::size_t squares = n * n;
  Problem p;
  p.bias.assign(squares, 1.0);
  Couplings couplings(squares);
  double constant = 2.0 * static_cast<double>(n) - static_cast<double>(squares);
  for (std::size_t a = 0; a < squares; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!attack(n, a, b)) continue;
      couplings.add(a, b, -0.5);
      p.bias[a] -= 0.5, p.bias[b] -= 0.5;
      constant += 0.5;
    }
  p.W = couplings.matrix();
  Dice dice(seed);
  for (std::size_t s = 0; s < squares; ++s) p.start.push_back(dice.between(-0.1, 0.1));
  p.least_energy = -constant;
  p.verdict = [n](const std::vector<double>& V) { return judge(n, V); };
  return p;
}

} // namespace hopmesh::problems
