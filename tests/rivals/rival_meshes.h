// Meshes that the tests of rivals fly.
#pragma once

#include "sim/rivals/integrator.h"

namespace hopmesh::tests {

/// A weight of 0.5 kg below a pin, on a spring of k = 10 N/m and length 1 m, falling at 2 m/s^2 through air
/// of drag 0.3/s: on its line the spring is linear, a = -20 (z + 1) - 0.3 v - 2.
inline scene::Mesh hanging_weight() {
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, -1}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, 5, 1}};
  mesh.mass = 0.5;
  return mesh;
}
inline const rivals::Surroundings falling{{0, 0, -2}, 0.3};

/// A square sheet of 1 m and 1 kg, structural and shear springs of k = 2 alpha, pinned at its first column
/// where `pinned`: the scene `banner` with 20 nodes a side and alpha 50.
inline scene::Mesh sheet(std::uint32_t side, double alpha, bool pinned = true) {
  scene::Mesh mesh;
  const double pitch = 1.0 / (side - 1);
  mesh.mass = 1.0 / (side * side);
  for (std::uint32_t r = 0; r < side; ++r)
    for (std::uint32_t c = 0; c < side; ++c) {
      mesh.position.push_back({c * pitch, 0, -(r * pitch)});
      mesh.pinned.push_back(pinned && c == 0);
    }
  for (std::uint32_t r = 0; r < side; ++r)
    for (std::uint32_t c = 0; c < side; ++c) {
      const std::uint32_t n = r * side + c;
      if (c + 1 < side) mesh.springs.push_back({{n, n + 1}, alpha, pitch});
      if (r + 1 == side) continue;
      const double diagonal = pitch * std::sqrt(2.0);
      if (c > 0) mesh.springs.push_back({{n, n + side - 1}, alpha, diagonal});
      mesh.springs.push_back({{n, n + side}, alpha, pitch});
      if (c + 1 < side) mesh.springs.push_back({{n, n + side + 1}, alpha, diagonal});
    }
  return mesh;
}
inline const rivals::Surroundings banner_air{{9.81, 3, 0}, 0.2};

/// Root mean square distance of nodes, positions [3 * nodes].
inline double distance(const rivals::Vector& a, const rivals::Vector& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.size() / 3));
}

} // namespace hopmesh::tests
