// The paper's flag, any size, built by hand.
#pragma once

#include "sim/reference/reference.h"

#include <cmath>

namespace hopmesh::tests {

/// A flag hanging by its left column: rows x columns, unit pitch, structural springs and both diagonals.
inline scene::Mesh flag(std::uint32_t rows, std::uint32_t columns) {
  scene::Mesh mesh;
  const auto join = [&](std::uint32_t i, std::uint32_t j, double length) {
    mesh.springs.push_back({{std::min(i, j), std::max(i, j)}, 1, length});
  };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t n = r * columns + c;
      mesh.position.push_back({double(c), 0, -double(r)});
      mesh.pinned.push_back(c == 0);
      if (c > 0) join(n - 1, n, 1);
      if (r > 0) join(n - columns, n, 1);
      if (r > 0 && c > 0) join(n - columns - 1, n, std::sqrt(2.0));
      if (r > 0 && c > 0) join(n - columns, n - 1, std::sqrt(2.0));
    }
  return mesh;
}

/// The settings of the paper's flags.
inline reference::StepParameters flying() {
  reference::StepParameters motion{};
  motion.time_step = 0.05;
  motion.friction = 0.99;
  motion.gamma = 4000;
  motion.beta = 1;
  motion.force = {0.3, 0.1, -0.1};
  motion.threshold = 1e-4;
  motion.max_sweeps = 300;
  motion.expansions = 1;
  return motion;
}

} // namespace hopmesh::tests
