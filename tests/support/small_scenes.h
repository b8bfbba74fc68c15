// Scenes of a few nodes, and an array fine enough to be compared with double.
#pragma once

#include "rtl_model/spec/array_rules.h"
#include "sim/levels/built_mesh.h"

namespace hopmesh::tests {

/// A grid with its left column pinned, structural and shear springs, blown and pulled like the flags.
inline scene::Scene grid_scene(int rows, int columns) {
  scene::Scene scene;
  scene.name = "grid";
  scene.mesh.grid = scene::Grid{rows, columns, 1.0};
  scene.mesh.pinned = {std::string("left")};
  scene.force.gravity = {0, 0, -0.1};
  scene.force.wind = scene::Vector3{0.3, 0.1, 0};
  return scene;
}

/// 24 and more bits everywhere, each sum exact.
inline spec::ArraySpec fine_array() {
  spec::ArraySpec a;
  a.name = "fine";
  a.normaliser = spec::Normaliser::divider;
  a.formats.weight = {25, 1, spec::Rounding::rnd, spec::Overflow::sat};
  a.formats.bias = {32, 8, spec::Rounding::rnd, spec::Overflow::sat};
  a.formats.drive = a.formats.state = a.formats.link = {26, 2, spec::Rounding::trn_zero, spec::Overflow::sat};
  return a;
}

} // namespace hopmesh::tests
