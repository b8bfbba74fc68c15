// Located keys -> a scene, checked as far as that goes without building the mesh.
#pragma once

#include "sim/input/toml_source.h"
#include "sim/scene/scene.h"

namespace hopmesh::scene {

/// Applies an override to the source of a scene; a mesh given by grid replaces one given by file, and the
/// reverse.
void override_scene(input::TomlSource& source, const std::string& key, const std::string& text);

/// `path` names the scene file, for the default name and for finding the mesh file beside it.
Scene read_scene(const input::TomlSource& source, const std::string& path, SceneTable table = scene_keys);

/// A mistake that only shows when the mesh is built, placed at the key that caused it.
input::InputError scene_error(const Scene& scene, const std::string& key, const std::string& found,
                              const std::string& expected, const std::string& nearest = "");

} // namespace hopmesh::scene
