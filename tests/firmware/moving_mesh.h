// A mesh in the firmware's hands: its state between steps, and a solver in double that stands for an array.
#pragma once

#include "tests/firmware/reference_pair.h"

extern "C" {
#include "firmware/bus.h"
}

namespace hopmesh::tests {

/// The rule of docs/method/theory.md, section 3, in double and in number order, on the firmware's own layout.
inline int relax_in_double(void*, const hm_mesh* m, hm_network* n, double threshold, std::uint32_t max_sweeps,
                           hm_relaxation* result) {
  *result = {};
  while (result->sweeps < max_sweeps && !result->converged) {
    double largest = 0;
    for (std::uint32_t c = 0; c < m->cells; ++c)
      for (std::uint32_t p = 0; p < m->components; ++p) {
        const double bias = n->bias[c * m->components + p];
        double s = bias, norm = std::abs(bias);
        for (std::uint32_t k = 0; k < hm_row_length(m, c); ++k) {
          const double w = n->weight[hm_row_offset(m, c, p) + k];
          const std::uint32_t block = k / m->components;
          const std::uint32_t source = block == 0 ? c : m->link_to[m->first_link[c] + block - 1];
          s += w * n->output[source * m->components + k % m->components];
          norm += std::abs(w);
        }
        if (norm == 0) continue;
        double& v = n->output[c * m->components + p];
        const double u = s / norm, moved = (u >= 0 ? 1 - v : 1 + v) * u;
        v += moved;
        largest = std::max(largest, std::abs(moved));
      }
    result->sweeps += 1;
    result->converged = largest <= threshold;
  }
  return HM_OK;
}

/// The firmware's state between steps, with its arrays.
struct Moving {
  explicit Moving(Pair& pair) {
    const std::size_t nodes = pair.scene.nodes();
    for (std::size_t k = 0; k < 3 * nodes; ++k) position.push_back(pair.scene.position[k / 3][k % 3]);
    velocity.resize(3 * nodes), acceleration.resize(3 * nodes), predicted.resize(3 * nodes);
    previous_position.resize(3 * nodes), previous_velocity.resize(3 * nodes);
    state.previous_position = previous_position.data(), state.previous_velocity = previous_velocity.data();
    direction.resize(3 * pair.firmware.mesh.cells), state.direction = direction.data();
    energy_change.resize(pair.firmware.mesh.cells), start.resize(pair.firmware.neurons());
    state.position = position.data(), state.velocity = velocity.data();
    state.acceleration = acceleration.data(), state.predicted = predicted.data();
    state.energy_change = energy_change.data(), state.start = start.data();
    state.network = pair.firmware.network;
  }
  std::vector<double> position, velocity, acceleration, predicted, energy_change, direction, start;
  std::vector<double> previous_position, previous_velocity;
  hm_state state{};
};

} // namespace hopmesh::tests
