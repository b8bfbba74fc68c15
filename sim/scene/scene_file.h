// Scene and array files (TOML) and --set overrides -> descriptions. Every mistake is an InputError.
#pragma once

#include "sim/input/array_file.h"
#include "sim/scene/scene.h"

namespace hopmesh::scene {

/// What a run was given: scene and array, with the overrides applied to either, and a line about each key
/// that was set and has no effect there.
struct Inputs {
  Scene scene;
  spec::ArraySpec array;
  std::vector<std::string> notes = {};
};

/// `scene`: a path, or the name of a shipped scene. `array`: a path, the name of a preset, or "" for the
/// default. `overrides`: "key.path=value" with keys of the scene or of the array. Checks everything that can
/// be checked without building the mesh, the array's rules included.
Inputs read_inputs(const std::string& scene, const std::string& array,
                   const std::vector<std::string>& overrides);

/// The whole description with every default filled in, as TOML that read_inputs takes back; of the array:
/// input::array_text.
std::string scene_text(Scene scene, SceneTable table = scene_keys);

/// Reads both back. They stand in `file`, each from a line of its own on, which messages name.
struct PlacedText {
  std::string text;
  int line = 1;
};
Inputs inputs_of(const PlacedText& scene, const PlacedText& array, const std::string& file);

} // namespace hopmesh::scene
