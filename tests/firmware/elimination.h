// The answer of a definite network without any of the ways that it is judged by: elimination.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace hopmesh::tests {

/// x of H x = b, H symmetric and positive definite, row by row: Cholesky within a band.
inline std::vector<double> solved(std::vector<std::vector<double>> H, std::vector<double> b,
                                  std::size_t band) {
  const std::size_t n = b.size();
  const auto first = [&](std::size_t row) { return row > band ? row - band : 0; };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = first(i); j <= i; ++j) {
      double sum = H[i][j];
      for (std::size_t k = std::max(first(i), first(j)); k < j; ++k) sum -= H[i][k] * H[j][k];
      if (i == j && !(sum > 0)) throw std::runtime_error("not definite");
      H[i][j] = i == j ? std::sqrt(sum) : sum / H[j][j];
    }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = first(i); k < i; ++k) b[i] -= H[i][k] * b[k];
    b[i] /= H[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    b[i] /= H[i][i];
    for (std::size_t k = first(i); k < i; ++k) b[k] -= H[i][k] * b[i];
  }
  return b;
}

} // namespace hopmesh::tests
