// Power iteration over the springs: K is never written down.
#include "sim/scene/frequency.h"

#include <cmath>

namespace hopmesh::scene {

namespace {

constexpr int rounds = 2000;
constexpr double close_enough = 1e-9; // relative change of the eigenvalue in a round

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

double norm(const std::vector<Vector3>& x) {
  double sum = 0;
  for (const Vector3& v : x) sum += v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  return std::sqrt(sum);
}

// Neither smooth nor symmetric, so that no wave is missing in it.
std::vector<Vector3> first_guess(std::size_t nodes) {
  std::vector<Vector3> x(nodes);
  for (std::size_t k = 0; k < 3 * nodes; ++k)
    x[k / 3][k % 3] = std::sin(12.9898 * static_cast<double>(k + 1));
  return x;
}

} // namespace

double largest_frequency(const Mesh& mesh) {
  std::vector<Vector3> x = first_guess(mesh.nodes());
  hold(mesh, x);
  double value = 0;
  for (int round = 0; round < rounds; ++round) {
    const double size = norm(x);
    if (size == 0) return 0;
    for (Vector3& v : x)
      for (double& component : v) component /= size;
    std::vector<Vector3> y(mesh.nodes(), Vector3{});
    for (const Spring& s : mesh.springs) add_spring(mesh, s, x, y);
    hold(mesh, y);
    const double before = value;
    value = norm(y) / mesh.mass;
    x = std::move(y);
    if (std::fabs(value - before) <= close_enough * value) break;
  }
  return std::sqrt(value);
}

} // namespace hopmesh::scene
