// The network of a step, written anew from docs/method/theory.md, sections 1 and 2, with plain loops: what
// the files of `hopmesh network` are held to. Dense, over all nodes; rows of pinned nodes stay empty.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace hopmesh::tests {

struct HandSpring {
  std::size_t a, b;
  double alpha, rest;
};

struct HandMesh {
  std::size_t nodes;
  std::vector<bool> pinned;
  std::vector<HandSpring> springs;
};

struct HandNetwork {
  std::vector<std::vector<double>> W;
  std::vector<double> bias;
};

using HandBlock = std::array<std::array<double, 3>, 3>;

/// A spring between its ends at C + h V0: along `u`, and what its curvature adds to their blocks.
struct HandPull {
  std::array<double, 3> u{};
  double ratio = 0; ///< of the length at rest to the length
  HandBlock curvature{};
};

inline HandPull pull_of(const HandSpring& s, double h, const std::vector<double>& C,
                        const std::vector<double>& V0) {
  HandPull pull;
  double square = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    pull.u[p] = C[3 * s.a + p] - C[3 * s.b + p] + h * (V0[3 * s.a + p] - V0[3 * s.b + p]);
    square += pull.u[p] * pull.u[p];
  }
  pull.ratio = s.rest / std::sqrt(square);
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t q = 0; q < 3; ++q) {
      const double unit = p == q ? 1 : 0, ww = pull.u[p] * pull.u[q] / square;
      pull.curvature[p][q] = 2 * s.alpha * h * h * (unit - pull.ratio * (unit - ww));
    }
  return pull;
}

/// C: [3 * nodes]; V0: [3 * nodes]; beta: the scene's key.
inline HandNetwork network_by_hand(const HandMesh& mesh, double dt, double beta, const std::vector<double>& C,
                                   const std::vector<double>& V0) {
  const std::size_t n = 3 * mesh.nodes;
  const double h = dt * dt / 2;
  std::vector<std::vector<double>> H(n, std::vector<double>(n, 0.0));
  std::vector<double> g(n, 0.0), alpha_sum(mesh.nodes, 0.0), alpha_count(mesh.nodes, 0.0);
  const auto add = [&](std::size_t i, std::size_t j, const HandBlock& block, double sign) {
    if (mesh.pinned[i] || mesh.pinned[j]) return;
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = 0; q < 3; ++q) H[3 * i + p][3 * j + q] += sign * block[p][q];
  };
  for (const HandSpring& s : mesh.springs) {
    const auto [u, ratio, S] = pull_of(s, h, C, V0);
    add(s.a, s.a, S, 1), add(s.b, s.b, S, 1), add(s.a, s.b, S, -1), add(s.b, s.a, S, -1);
    for (std::size_t p = 0; p < 3; ++p) {
      const double f = 2 * s.alpha * h * (1 - ratio) * u[p];
      if (!mesh.pinned[s.a]) g[3 * s.a + p] += f;
      if (!mesh.pinned[s.b]) g[3 * s.b + p] -= f;
    }
    for (std::size_t node : {s.a, s.b}) alpha_sum[node] += s.alpha, alpha_count[node] += 1;
  }
  for (std::size_t i = 0; i < mesh.nodes; ++i) {
    if (mesh.pinned[i]) continue;
    const double b = beta * dt * dt * dt * dt * alpha_sum[i] / alpha_count[i];
    const double F =
        std::sqrt(V0[3 * i] * V0[3 * i] + V0[3 * i + 1] * V0[3 * i + 1] + V0[3 * i + 2] * V0[3 * i + 2]);
    for (std::size_t p = 0; p < 3; ++p) {
      g[3 * i + p] += 2 * b * (F - 1) * V0[3 * i + p] / F;
      for (std::size_t q = 0; q < 3; ++q) {
        const double unit = p == q ? 1 : 0, mm = V0[3 * i + p] * V0[3 * i + q] / (F * F);
        H[3 * i + p][3 * i + q] += 2 * b * (unit - (unit - mm) / F);
      }
    }
  }
  HandNetwork network{H, std::vector<double>(n, 0.0)};
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c) network.W[r][c] = -H[r][c], network.bias[r] += H[r][c] * V0[c];
  for (std::size_t r = 0; r < n; ++r) network.bias[r] -= g[r];
  return network;
}

} // namespace hopmesh::tests
