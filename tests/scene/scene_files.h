// Small scenes and files for the tests of this folder.
#pragma once

#include "sim/scene/mesh.h"
#include "sim/scene/scene_file.h"

#include "place.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace hopmesh::scene::testing {

inline const std::string folder = HOPMESH_SOURCE_DIR "/tests/scene/";

/// A folder of its own that is gone after the test.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hopmesh-XXXXXX").string();
    path_ = ::mkdtemp(name.data()) ? name : "";
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& name) const { return path_ + '/' + name; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  std::string path_;
};

inline Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TempFolder temp;
  return read_inputs(temp.write("scene.toml", text), "", overrides).scene;
}

/// A scene with nothing but a grid.
inline Scene grid_scene(int rows, int columns, double pitch = 1.0) {
  Scene scene;
  scene.mesh.grid = Grid{rows, columns, pitch};
  return scene;
}

/// A scene with nothing but a mesh file.
inline Scene file_scene(const std::string& path) {
  Scene scene;
  scene.mesh.file = path;
  scene.mesh.shear = scene.mesh.bend = 0;
  return scene;
}

inline Mesh mesh_of_obj(const std::string& text) {
  const TempFolder temp;
  return build_mesh(file_scene(temp.write("mesh.obj", text)));
}

/// What the action's InputError says; "" if it throws none.
template <typename Action> std::string complaint(Action action) {
  try {
    action();
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace hopmesh::scene::testing
