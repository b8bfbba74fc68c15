#include "tests/support/box_solver.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::tests {
namespace {

using Real = long double;

/// W by rows, the diagonal apart.
struct Rows {
  std::vector<std::size_t> first, column;
  std::vector<double> weight, diagonal;
  double largest = 0;

  Rows(const files::SparseMatrix& W, const std::vector<double>& bias)
      : first(W.rows + 1, 0), diagonal(W.rows, 0.0) {
    for (const files::MatrixEntry& e : W.entries) {
      largest = std::max(largest, std::abs(e.value));
      if (e.row == e.column) {
        diagonal[e.row] = e.value;
        continue;
      }
      first[e.row + 1] += 1;
      column.push_back(e.column);
      weight.push_back(e.value);
    }
    for (std::size_t i = 0; i < W.rows; ++i) first[i + 1] += first[i];
    for (double b : bias) largest = std::max(largest, std::abs(b));
  }

  /// Of the others and the bias, without the output itself.
  template <typename T>
  Real pull(std::size_t i, const std::vector<T>& V, const std::vector<double>& bias) const {
    Real sum = bias[i];
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) sum += static_cast<Real>(weight[k]) * V[column[k]];
    return sum;
  }
};

/// -pull v - diagonal v^2 / 2 on [-1, 1]; a flat one leaves v.
Real least_along(Real pull, Real diagonal, Real v) {
  if (diagonal < 0) return std::clamp(-pull / diagonal, Real(-1), Real(1));
  if (pull != 0) return pull > 0 ? 1 : -1;
  return diagonal == 0 ? v : v >= 0 ? 1 : -1;
}

template <typename T>
Real energy_of(const Rows& rows, const std::vector<double>& bias, const std::vector<T>& V) {
  Real energy = 0;
  for (std::size_t i = 0; i < V.size(); ++i)
    energy -= V[i] * (rows.pull(i, V, bias) + bias[i] + rows.diagonal[i] * V[i]) / 2;
  return energy;
}

double kkt_of(const Rows& rows, const std::vector<double>& bias, const std::vector<Real>& V) {
  Real largest = 0;
  for (std::size_t i = 0; i < V.size(); ++i) {
    const Real s = rows.pull(i, V, bias) + rows.diagonal[i] * V[i];
    const Real step = rows.largest > 0 ? s / rows.largest : 0;
    largest = std::max(largest, std::abs(std::clamp(V[i] + step, Real(-1), Real(1)) - V[i]));
  }
  return static_cast<double>(largest);
}

} // namespace

BoxAnswer least_on_box(const files::SparseMatrix& W, const std::vector<double>& bias,
                       const std::vector<double>& start, double tolerance, std::size_t most_sweeps) {
  const Rows rows(W, bias);
  std::vector<Real> V(start.begin(), start.end());
  BoxAnswer answer;
  for (std::size_t sweep = 0; sweep < most_sweeps && !answer.solved; ++sweep) {
    for (std::size_t i = 0; i < V.size(); ++i)
      V[i] = least_along(rows.pull(i, V, bias), rows.diagonal[i], V[i]);
    if (sweep % 8 != 0) continue;
    answer.kkt = kkt_of(rows, bias, V);
    answer.solved = answer.kkt <= tolerance;
  }
  answer.energy = static_cast<double>(energy_of(rows, bias, V));
  answer.V.assign(V.begin(), V.end());
  return answer;
}

// Along a Gray code: a corner differs from the one before it in one output, and so does its energy.
double least_at_corners(const files::SparseMatrix& W, const std::vector<double>& bias) {
  const Rows rows(W, bias);
  std::vector<double> V(W.rows, -1.0);
  Real energy = energy_of(rows, bias, V), least = energy;
  for (std::uint64_t k = 1; k < std::uint64_t{1} << W.rows; ++k) {
    const auto turned = static_cast<std::size_t>(__builtin_ctzll(k));
    energy += 2 * V[turned] * rows.pull(turned, V, bias);
    V[turned] = -V[turned];
    least = std::min(least, energy);
  }
  return static_cast<double>(least);
}

} // namespace hopmesh::tests
