// The slow, obvious oracle: the energies of docs/method/theory.md, section 1, straight from their formulas,
// with loops and no linear algebra, in more digits than double has. Finite differences of it need no luck
// with the step width.
#pragma once

#include "sim/reference/reference.h"

#include <cmath>
#include <functional>

namespace hopmesh::tests {

#ifdef __SIZEOF_FLOAT128__
using Wide = __float128; // 113 bits
#else
using Wide = long double; // 113 bits on the other 64-bit machines
#endif
using WideVector = std::vector<Wide>;

inline Wide wide_sqrt(Wide x) {
  if (x <= 0) return 0;
  Wide y = std::sqrt(static_cast<double>(x));
  for (int k = 0; k < 2; ++k) y = (y + x / y) / 2; // Newton: 53 -> 106 -> all bits
  return y;
}

inline WideVector widened(const reference::Vector& v) {
  return {v.begin(), v.end()};
}

/// Where node `n` is in space once its outputs have acted for a step: C + h V.
inline std::array<Wide, 3> place(const scene::Mesh& mesh, Wide h, const reference::Vector& C,
                                 const WideVector& V, std::size_t n) {
  std::array<Wide, 3> at = {C[3 * n], C[3 * n + 1], C[3 * n + 2]};
  if (mesh.planar) {
    at[0] += h * V[2 * n];
    at[2] += h * V[2 * n + 1];
  } else
    for (int p = 0; p < 3; ++p) at[p] += h * V[3 * n + p];
  return at;
}

inline Wide plain_spring(const scene::Spring& spring, const std::array<Wide, 3>& a,
                         const std::array<Wide, 3>& b) {
  Wide squares = 0;
  for (int p = 0; p < 3; ++p) squares += (a[p] - b[p]) * (a[p] - b[p]);
  const Wide stretch = wide_sqrt(squares) - spring.rest_length;
  return spring.weight * stretch * stretch;
}

inline Wide plain_beta(const scene::Mesh& mesh, const reference::StepParameters& motion, std::size_t node) {
  Wide sum = 0, count = 0;
  for (const auto& spring : mesh.springs)
    if (spring.node[0] == node || spring.node[1] == node) {
      sum += spring.weight;
      count += 1;
    }
  const Wide dt = motion.time_step;
  return count == 0 ? Wide(0) : motion.beta * dt * dt * dt * dt * sum / count;
}

/// E(V) of docs/method/theory.md, section 1.
inline Wide plain_energy(const scene::Mesh& mesh, const reference::StepParameters& motion,
                         const reference::Vector& C, const WideVector& V) {
  const Wide h = Wide(motion.time_step) * motion.time_step / 2;
  Wide sum = 0;
  for (const auto& spring : mesh.springs)
    sum += plain_spring(spring, place(mesh, h, C, V, spring.node[0]), place(mesh, h, C, V, spring.node[1]));
  const std::size_t k = mesh.planar ? 2 : 3;
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    if (mesh.pinned[n]) continue;
    Wide squares = 0;
    for (std::size_t p = 0; p < k; ++p) squares += V[k * n + p] * V[k * n + p];
    sum += plain_beta(mesh, motion, n) * (1 - wide_sqrt(squares)) * (1 - wide_sqrt(squares));
  }
  return sum;
}

// Central differences of step d are off by d^2 times a higher derivative (about 1e-12 of the uncancelled
// terms for d = 1e-7 and outputs at least 0.2 long) and by the rounding of E itself, epsilon |E| / d^2.
constexpr double difference_step = 1e-7;

/// What rounding may do to `curvature`; for `slope` it is less by a factor d. Some 30 terms of E, four times
/// over.
inline double difference_noise(Wide E) {
  const double epsilon = 2e-34;
  return 128 * epsilon * static_cast<double>(E) / (difference_step * difference_step);
}

inline double slope(const std::function<Wide(const WideVector&)>& f, WideVector V, std::size_t i) {
  const Wide d = difference_step, start = V[i];
  V[i] = start + d;
  const Wide above = f(V);
  V[i] = start - d;
  return static_cast<double>((above - f(V)) / (2 * d));
}

inline double curvature(const std::function<Wide(const WideVector&)>& f, const WideVector& V, std::size_t i,
                        std::size_t j) {
  const Wide d = difference_step;
  const auto moved = [&](int along_i, int along_j) {
    WideVector there = V;
    there[i] += along_i * d;
    there[j] += along_j * d;
    return f(there);
  };
  return static_cast<double>((moved(1, 1) - moved(1, -1) - moved(-1, 1) + moved(-1, -1)) / (4 * d * d));
}

} // namespace hopmesh::tests
