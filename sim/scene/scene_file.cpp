// Finds the files a run names, deals out its overrides, and reads scene and array.
#include "sim/scene/scene_file.h"

#include "sim/scene/array_file.h"
#include "sim/scene/scene_reader.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

namespace fs = std::filesystem;

using Overrides = std::vector<std::pair<std::string, std::string>>;

bool is_array_key(const std::string& key) {
  const std::string table = key.substr(0, key.find('.'));
  return table == "array" || table == "formats";
}

/// A bare word is first the name of a shipped scene; whoever means a file of that name writes ./name.
std::string scene_path(const std::string& scene) {
  const std::vector<std::string> shipped = shipped_scenes();
  if (std::binary_search(shipped.begin(), shipped.end(), scene))
    return (fs::path(shipped_folder()) / (scene + ".toml")).string();
  std::error_code ignored;
  const bool is_path = scene.find('/') != std::string::npos || fs::path(scene).extension() == ".toml";
  if (is_path || fs::is_regular_file(scene, ignored)) return scene;
  throw input_error("", 0, "scene", in_quotes(scene),
                    fmt::format("a scene file, or one of {}", fmt::join(shipped, ", ")),
                    nearest_name(scene, shipped));
}

} // namespace

Inputs read_inputs(const std::string& scene, const std::string& array,
                   const std::vector<std::string>& overrides) {
  const std::string path = scene_path(scene);
  TomlSource source = TomlSource::read(path, "a scene file");
  Overrides of_array;
  for (const std::string& text : overrides) {
    auto split = split_override(text);
    if (is_array_key(split.first))
      of_array.push_back(std::move(split));
    else
      override_scene(source, split.first, split.second);
  }
  return {read_scene(source, path), read_array(array, of_array)};
}

namespace {

TomlSource placed(const PlacedText& text, const std::string& file) {
  return TomlSource::of_text(std::string(static_cast<std::size_t>(text.line - 1), '\n') + text.text, file);
}

} // namespace

Inputs inputs_of(const PlacedText& scene, const PlacedText& array, const std::string& file) {
  return {read_scene(placed(scene, file), file), array_of(placed(array, file), file)};
}

std::string shipped_folder() {
  std::error_code ignored;
  // Beside an installed program first: an installation may have been moved, or the tree it came from be gone.
  const fs::path beside =
      fs::read_symlink("/proc/self/exe", ignored).parent_path() / HOPMESH_SCENES_FROM_PROGRAM;
  for (const fs::path& folder : {beside, fs::path(HOPMESH_SCENES)})
    if (fs::is_directory(folder, ignored)) return folder.lexically_normal().string();
  return HOPMESH_INSTALLED_SCENES;
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(shipped_folder(), ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

} // namespace hopmesh::scene
