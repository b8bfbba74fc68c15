// A random mesh as the firmware and as the reference see it, for tests that compare what they make of it.
#pragma once

#include "sim/reference/reference.h"
#include "tests/support/firmware_mesh.h"
#include "tests/support/random_network.h"

extern "C" {
#include "firmware/integrator.h"
}

#include <algorithm>
#include <cmath>

namespace hopmesh::tests {

/// A crooked grid with random weights, some pins and some slack or stretched springs.
inline scene::Mesh random_scene_mesh(Dice& dice, bool planar) {
  scene::Mesh mesh;
  mesh.planar = planar;
  const std::uint32_t rows = 2 + static_cast<std::uint32_t>(dice.below(4)),
                      columns = 2 + static_cast<std::uint32_t>(dice.below(4));
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const auto off = [&] { return 0.3 * (dice.unit() - 0.5); };
      mesh.position.push_back({c + off(), planar ? 0.0 : off(), r + off()});
      mesh.pinned.push_back(dice.one_in(4));
    }
  mesh.pinned.front() = true;
  mesh.pinned.back() = false;
  for (std::uint32_t i = 0; i < rows * columns; ++i)
    for (std::uint32_t j = i + 1; j < rows * columns; ++j) {
      const auto apart = [&](std::uint32_t x, std::uint32_t y) { return x > y ? x - y : y - x; };
      if (apart(i / columns, j / columns) > 1 || apart(i % columns, j % columns) > 1) continue;
      mesh.springs.push_back({{i, j}, 0.2 + 2 * dice.unit(), dice.one_in(6) ? 0.0 : 0.5 + dice.unit()});
    }
  if (dice.one_in(4)) mesh.law = scene::SpringLaw::tension, mesh.floor = 0.01 + dice.unit();
  return mesh;
}

inline std::vector<PlainSpring> plain_springs(const scene::Mesh& mesh) {
  std::vector<PlainSpring> springs;
  for (const scene::Spring& s : mesh.springs)
    springs.push_back({s.node[0], s.node[1], s.weight, s.rest_length});
  return springs;
}

/// The two faces of one mesh. The reference numbers the neurons of all nodes, the firmware those of the free
/// ones.
struct Pair {
  explicit Pair(const scene::Mesh& a_mesh)
      : scene(a_mesh), firmware(plain_springs(a_mesh), a_mesh.pinned, a_mesh.planar ? 2 : 3) {
    firmware.mesh.law = a_mesh.law == scene::SpringLaw::tension ? HM_TENSION : HM_LINEAR;
    firmware.mesh.floor = a_mesh.floor;
    hm_mesh_connect(&firmware.mesh);
  }

  Eigen::Index reference_index(std::uint32_t cell, std::uint32_t p) const {
    return Eigen::Index{firmware.mesh.components} * firmware.mesh.node_of_cell[cell] + p;
  }
  Eigen::Index reference_size() const {
    return static_cast<Eigen::Index>(firmware.mesh.components * scene.nodes());
  }

  scene::Mesh scene;
  FirmwareMesh firmware;
};

/// The two tables of formulations are in one order: a test of the integrator compares their names.
inline const reference::Formulation* reference_formulation(const hm_formulation* of_firmware) {
  const auto at = std::find(std::begin(hm_formulations), std::end(hm_formulations), of_firmware);
  return reference::formulations[at - std::begin(hm_formulations)];
}

inline reference::StepParameters reference_motion(const hm_step_parameters& m) {
  reference::StepParameters r{};
  r.formulation = reference_formulation(m.formulation), r.mass = m.mass, r.drag = m.drag;
  r.time_step = m.time_step, r.friction = m.friction, r.gamma = m.gamma, r.beta = m.beta;
  r.acceleration_memory = m.acceleration_memory;
  r.energy_of_all_springs = m.energy_of_all_springs != 0;
  r.force_on_acceleration = m.force_on_acceleration != 0;
  r.force = {m.force[0], m.force[1], m.force[2]};
  r.threshold = m.threshold, r.max_sweeps = m.max_sweeps, r.expansions = m.expansions;
  return r;
}

} // namespace hopmesh::tests
