// Small scenes and files for the tests of this folder.
#pragma once

#include "sim/scene/mesh.h"
#include "sim/scene/scene_file.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include "place.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

inline const std::string folder = HOPMESH_SOURCE_DIR "/tests/scene/";

inline scene::Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Folder temp;
  return scene::read_inputs(temp.write("scene.toml", text), "", overrides).scene;
}

/// A scene with nothing but a grid.
inline scene::Scene grid_scene(int rows, int columns, double pitch = 1.0) {
  scene::Scene scene;
  scene.mesh.grid = scene::Grid{rows, columns, pitch};
  return scene;
}

/// A scene with nothing but a mesh file.
inline scene::Scene file_scene(const std::string& path) {
  scene::Scene scene;
  scene.mesh.file = path;
  scene.mesh.shear = scene.mesh.bend = 0;
  return scene;
}

inline scene::Mesh mesh_of_obj(const std::string& text) {
  const Folder temp;
  return scene::build_mesh(file_scene(temp.write("mesh.obj", text)));
}

} // namespace hopmesh::tests
