// Lanczos' recurrence over the springs: K is never written down.
#include "sim/scene/frequency.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::scene {

namespace {

constexpr int rounds = 2000, rounds_a_look = 8;
constexpr double close_enough = 1e-12; // relative change of the eigenvalue between two looks
constexpr double nothing_new = 1e-13;  // of K: what is left of a vector beside those before it
constexpr int halvings = 60;

/// y += K_spring x: k (w w^T + (1 - L/l)(1 - w w^T)) on the difference of the ends, T/l (1 - w w^T) under a
/// constant tension T.
void add_spring(const Mesh& mesh, const Spring& s, const std::vector<Vector3>& x, std::vector<Vector3>& y) {
  const std::uint32_t i = s.node[0], j = s.node[1];
  Vector3 w{}, d{};
  double length = 0, along = 0;
  for (std::size_t p = 0; p < 3; ++p) w[p] = mesh.position[i][p] - mesh.position[j][p], length += w[p] * w[p];
  length = std::sqrt(length);
  for (std::size_t p = 0; p < 3; ++p) d[p] = x[i][p] - x[j][p], along += d[p] * w[p] / length;
  const bool tense = mesh.law == SpringLaw::tension;
  const double across = tense ? s.weight / length : 2 * s.weight * (1 - s.rest_length / length);
  const double lengthwise = tense ? 0 : 2 * s.weight;
  for (std::size_t p = 0; p < 3; ++p) {
    const double pull = across * d[p] + (lengthwise - across) * along * w[p] / length;
    y[i][p] += pull, y[j][p] -= pull;
  }
}

void hold(const Mesh& mesh, std::vector<Vector3>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (mesh.pinned[i]) x[i] = {};
    if (mesh.planar) x[i][1] = 0;
  }
}

double dot(const std::vector<Vector3>& x, const std::vector<Vector3>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i][0] * y[i][0] + x[i][1] * y[i][1] + x[i][2] * y[i][2];
  return sum;
}

void scale(std::vector<Vector3>& x, double by) {
  for (Vector3& v : x)
    for (double& component : v) component *= by;
}

void subtract(std::vector<Vector3>& x, double times, const std::vector<Vector3>& y) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t p = 0; p < 3; ++p) x[i][p] -= times * y[i][p];
}

// Neither smooth nor symmetric, so that no wave is missing in it.
std::vector<Vector3> first_guess(std::size_t nodes) {
  std::vector<Vector3> x(nodes);
  for (std::size_t k = 0; k < 3 * nodes; ++k)
    x[k / 3][k % 3] = std::sin(12.9898 * static_cast<double>(k + 1));
  return x;
}

/// K as the vectors met so far see it: symmetric, with this diagonal, and `beside` it.
struct Tridiagonal {
  std::vector<double> diagonal, beside;

  double reach() const {
    double most = 0;
    for (std::size_t k = 0; k < diagonal.size(); ++k)
      most = std::max(most, std::fabs(diagonal[k]) + std::fabs(beside[k]) + (k > 0 ? beside[k - 1] : 0));
    return most;
  }

  /// Has `sign` times it an eigenvalue above x? As many as there are pivots above 0.
  bool reaches(double sign, double x) const {
    double pivot = 1;
    for (std::size_t k = 0; k < diagonal.size(); ++k) {
      const double across = k > 0 ? beside[k - 1] : 0;
      pivot = sign * diagonal[k] - x - across * across / pivot;
      if (pivot > 0) return true;
      if (pivot == 0) pivot = -1e-300;
    }
    return false;
  }

  /// Largest size of an eigenvalue.
  double largest() const {
    double low = 0, high = reach();
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2;
      (reaches(1, middle) || reaches(-1, middle) ? low : high) = middle;
    }
    return high;
  }
};

} // namespace

double largest_frequency(const Mesh& mesh) {
  std::vector<Vector3> x = first_guess(mesh.nodes()), before(mesh.nodes(), Vector3{}), y;
  hold(mesh, x);
  const double size = std::sqrt(dot(x, x));
  if (size == 0) return 0;
  scale(x, 1 / size);
  Tridiagonal seen;
  double value = 0;
  for (int round = 1; round <= rounds; ++round) {
    y.assign(mesh.nodes(), Vector3{});
    for (const Spring& s : mesh.springs) add_spring(mesh, s, x, y);
    hold(mesh, y);
    seen.diagonal.push_back(dot(x, y));
    subtract(y, seen.diagonal.back(), x);
    if (round > 1) subtract(y, seen.beside.back(), before);
    const double left = std::sqrt(dot(y, y));
    seen.beside.push_back(0); // what comes after is not seen yet
    const bool all_seen = left <= nothing_new * seen.reach();
    if (all_seen || round % rounds_a_look == 0) {
      const double last = value;
      value = seen.largest();
      if (all_seen || std::fabs(value - last) <= close_enough * value) break;
    }
    seen.beside.back() = left;
    scale(y, 1 / left);
    before.swap(x);
    x.swap(y);
  }
  return std::sqrt(value / mesh.mass);
}

} // namespace hopmesh::scene
