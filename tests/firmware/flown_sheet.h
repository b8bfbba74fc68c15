// A sheet that the firmware flies on the software array, and each step's exact answer from another source.
#pragma once

#include "tests/firmware/elimination.h"
#include "tests/support/firmware_mesh.h"
#include "tests/support/soft_array.h"

extern "C" {
#include "firmware/driver.h"
#include "firmware/integrator.h"
#include "firmware/registers.h"
}

#include <cmath>

namespace hopmesh::tests {

/// The sheet of the shipped scenes: a grid held by its left column, structural and shear springs.
struct Sheet {
  std::uint32_t rows = 20, columns = 20;
  double pitch = 1.0 / 19, weight = 50, time_step = 0.01;
  double mass = 0.0025, drag = 0.2;
  double force[3] = {9.81, 3, 0};

  std::vector<PlainSpring> springs() const {
    std::vector<PlainSpring> all;
    const auto join = [&](std::uint32_t from, std::uint32_t to, double times) {
      all.push_back({from, to, weight, pitch * times});
    };
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const std::uint32_t at = r * columns + c;
        if (c + 1 < columns) join(at, at + 1, 1);
        if (r + 1 < rows) join(at, at + columns, 1);
        if (r + 1 < rows && c + 1 < columns) join(at, at + columns + 1, std::sqrt(2.0));
        if (r + 1 < rows && c > 0) join(at, at + columns - 1, std::sqrt(2.0));
      }
    return all;
  }
  std::vector<bool> pinned() const {
    std::vector<bool> all(rows * columns);
    for (std::uint32_t r = 0; r < rows; ++r) all[r * columns] = true;
    return all;
  }
};

inline spec::Topology topology_of(const hm_mesh& mesh) {
  spec::Topology t;
  t.neurons_per_cell = mesh.components;
  t.first_link.assign(mesh.first_link, mesh.first_link + mesh.cells + 1);
  t.link_to.assign(mesh.link_to, mesh.link_to + mesh.first_link[mesh.cells]);
  return t;
}

class FlownSheet {
 public:
  FlownSheet(const Sheet& sheet, const spec::ArraySpec& array)
      : mesh(sheet.springs(), sheet.pinned(), 3), port(array, topology_of(mesh.mesh)) {
    hm_mesh_connect(&mesh.mesh);
    const std::size_t all = 3 * mesh.mesh.nodes;
    for (std::uint32_t k = 0; k < mesh.mesh.nodes; ++k)
      for (const double x : {k % sheet.columns * sheet.pitch, 0.0, k / sheet.columns * -sheet.pitch})
        position.push_back(x);
    for (auto* some : {&velocity, &acceleration, &predicted, &previous_position, &previous_velocity})
      some->assign(all, 0.0);
    start.resize(mesh.neurons());
    correction.resize(4 * mesh.neurons());
    state.position = position.data(), state.velocity = velocity.data();
    state.acceleration = acceleration.data(), state.predicted = predicted.data();
    state.previous_position = previous_position.data(), state.previous_velocity = previous_velocity.data();
    state.start = start.data(), state.network = mesh.network, state.correction = correction.data();
    motion.formulation = &hm_backward_euler, motion.time_step = sheet.time_step, motion.friction = 1;
    motion.mass = sheet.mass, motion.drag = sheet.drag;
    std::copy(sheet.force, sheet.force + 3, motion.force);
    motion.threshold = 1e-4, motion.max_sweeps = 5000, motion.expansions = 1;
    if (hm_driver_open(&driver, &port.bus(), &mesh.mesh, buffer.data(), 4096) != HM_OK)
      throw std::runtime_error("the driver refuses the array");
  }

  hm_step_result step() {
    const hm_solver solver{&driver, hm_driver_relax, hm_driver_correct, hm_driver_room};
    hm_step_result result;
    if (hm_step(&mesh.mesh, &motion, &solver, &state, &result) != HM_OK) throw std::runtime_error("no step");
    return result;
  }

  /// Relative rms error of the last step's V against the answer of its own network in double, found by
  /// elimination.
  double error() const {
    const hm_mesh& m = mesh.mesh;
    const std::uint32_t n = mesh.neurons();
    std::vector<std::vector<double>> H(n, std::vector<double>(n));
    std::size_t band = 0;
    for (std::uint32_t c = 0, i = 0; c < m.cells; ++c)
      for (std::uint32_t p = 0; p < 3; ++p, ++i)
        for (std::uint32_t k = 0; k < hm_row_length(&m, c); ++k) {
          const std::uint32_t cell = k < 3 ? c : m.link_to[m.first_link[c] + k / 3 - 1], j = 3 * cell + k % 3;
          H[i][j] = -mesh.weight[hm_row_offset(&m, c, p) + k];
          if (j < i) band = std::max(band, std::size_t{i} - j);
        }
    const std::vector<double> exact = solved(std::move(H), mesh.bias, band);
    double off = 0, whole = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
      off += (mesh.output[k] - exact[k]) * (mesh.output[k] - exact[k]);
      whole += exact[k] * exact[k];
    }
    return std::sqrt(off / whole);
  }

  FirmwareMesh mesh;
  SoftArray port;
  hm_driver driver{};
  hm_state state{};
  hm_step_parameters motion{};

 private:
  std::vector<double> position, velocity, acceleration, predicted, previous_position, previous_velocity;
  std::vector<double> start, correction;
  std::vector<std::uint32_t> buffer = std::vector<std::uint32_t>(4096);
};

/// All neurons at once, with momentum, in words of these widths.
inline spec::ArraySpec momentum_array(int word, int state) {
  spec::ArraySpec a;
  a.output = spec::Output::momentum;
  a.schedule = spec::Schedule::synchronous;
  const auto format = [](int width, int integer) {
    return spec::NumberFormat{width, integer, spec::Rounding::rnd, spec::Overflow::sat};
  };
  a.formats.weight = format(word, 1), a.formats.link = format(word, 1);
  a.formats.state = a.formats.drive = format(state, 2);
  return a;
}

} // namespace hopmesh::tests
