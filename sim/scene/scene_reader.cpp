// Reading a scene by its table, and the rules that reach across keys.
#include "sim/scene/scene_reader.h"

#include "sim/input/utf8.h"

#include <filesystem>

namespace hopmesh::scene {

namespace {

namespace fs = std::filesystem;

/// A relative path of a mesh or picture is meant from the scene file's folder; one given by --set from where
/// the user stands.
void resolve(const Scene& scene, const char* key, std::string& file) {
  const auto line = scene.lines.find(key);
  if (line == scene.lines.end()) return;
  const fs::path folder = line->second == 0 ? fs::path() : fs::path(scene.source).parent_path();
  std::error_code error;
  const fs::path whole = fs::absolute(folder / file, error).lexically_normal();
  if (error)
    throw scene_error(scene, key, "a current folder that is gone", "an absolute path, or another folder");
  if (!input::is_utf8(whole.string()))
    throw scene_error(scene, key, input::in_quotes(whole.string()), "a path in UTF-8");
  file = whole.string();
}

/// The rules, of which each may refuse a key of the source.
struct Rules {
  const Scene& scene;
  const input::TomlSource& source;

  input::InputError error(const std::string& key, const std::string& expected) const {
    return source.error(*source.find(key), key, expected);
  }

  void check_shape() const {
    const MeshSpec& mesh = scene.mesh;
    if (mesh.grid && mesh.file) throw error(file_key, "either mesh.grid or mesh.file, not both");
    if (!mesh.grid && !mesh.file)
      throw input::input_error(scene.source, 0, "mesh", "no shape",
                               "mesh.grid = { rows, columns, pitch } or mesh.file");
  }

  void check_rest() const {
    if (scene.mesh.law == SpringLaw::tension && scene.mesh.rest.value_or(0) != 0)
      throw error("mesh.rest", "none beside law = \"tension\", which pulls alike at any length");
  }

  void check_start() const {
    const Vector3& v = scene.mesh.start.velocity;
    if (v != Vector3{0, 0, 0} && scene.is_static())
      throw error("mesh.start.velocity",
                  "none with incremental.rule = \"static\": nothing there has a speed");
    if (v[1] != 0 && scene.mesh.planar)
      throw error("mesh.start.velocity", "0 along y in a planar mesh: y never moves");
  }

  void check_image() const {
    if (scene.force.image && scene.motion.formulation == Formulation::probe)
      throw error(image_key, "formulation = \"incremental\" where an image pulls");
  }
};

} // namespace

void override_scene(input::TomlSource& source, const std::string& key, const std::string& text) {
  const bool of_file = key == file_key, of_grid = (key + ".").rfind(grid_table + std::string("."), 0) == 0;
  const char* const gone = of_file ? grid_table : file_key;
  Scene any;
  if (of_file || of_grid) source.erase(gone);
  for (const input::Key& other : scene_keys(any))
    if ((of_file || of_grid) && other.when.beside == std::string(gone)) source.erase(other.name);
  source.set(key, text);
}

Scene read_scene(const input::TomlSource& source, const std::string& path, SceneTable table) {
  Scene scene;
  scene.source = path;
  scene.name = fs::path(path).stem().string();
  for (const auto& [key, value] : source.values()) scene.lines[key] = value.line;
  input::expect_utf8("scene", scene.name);
  if (source.values().empty()) throw input::input_error(path, 0, "", "no key at all", "a scene file");
  if (source.find(file_key)) scene.mesh.shear = scene.mesh.bend = 0; // the edges of a file are all alike
  input::make_parts(source, table(scene));
  input::KeyReader reader(source);
  input::read_keys(reader, table(scene));
  reader.refuse_unknown();
  const Rules rules{scene, source};
  rules.check_shape();
  input::refuse_beside(source, table(scene));
  rules.check_rest();
  rules.check_start();
  rules.check_image();
  if (scene.mesh.file) resolve(scene, file_key, *scene.mesh.file);
  if (scene.force.image) resolve(scene, image_key, scene.force.image->file);
  return scene;
}

std::string scene_text(Scene scene, SceneTable table) {
  return input::toml_text(table(scene));
}

input::InputError scene_error(const Scene& scene, const std::string& key, const std::string& found,
                              const std::string& expected, const std::string& nearest) {
  const auto place = scene.lines.find(key);
  if (place == scene.lines.end()) return input::input_error(scene.source, 0, key, found, expected, nearest);
  return input::input_error(place->second == 0 ? "--set" : scene.source, place->second, key, found, expected,
                            nearest);
}

} // namespace hopmesh::scene
