// Every key of a scene, its range, and the rules between keys. docs/use/scene-files.md explains what the keys
// mean.
#include "sim/scene/scene_reader.h"

#include "sim/input/key_reader.h"
#include "sim/scene/limits.h"

#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace hopmesh::scene {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_count = 1'000'000'000; // of steps and sweeps: years of any machine

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// A relative path of a mesh or picture is meant from the scene file's folder; one given by --set from where
/// the user stands.
std::string resolved(const std::string& file, const std::string& scene_path, bool overridden) {
  const fs::path folder = overridden ? fs::path() : fs::path(scene_path).parent_path();
  return fs::absolute(folder / file).lexically_normal().string();
}

Pin read_pin(const input::TomlSource& source, const input::TomlValue& item, const std::string& key) {
  const std::string expected = input::one_of(pin_names) + ", or a node number";
  if (const auto* number = item.as<std::int64_t>()) {
    if (*number >= 0) return *number;
  } else if (const auto* name = item.as<std::string>()) {
    for (const std::string& valid : pin_names)
      if (*name == valid) return *name;
    throw source.error(item, key, expected, input::nearest_name(*name, pin_names));
  }
  throw source.error(item, key, expected);
}

class SceneReader {
 public:
  SceneReader(const input::TomlSource& source, const std::string& path) : source_(source), keys_(source) {
    scene_.source = path;
    scene_.name = fs::path(path).stem().string();
    for (const auto& [key, value] : source.values()) scene_.lines[key] = value.line;
  }

  Scene read() {
    if (source_.values().empty())
      throw input::input_error(scene_.source, 0, "", "no key at all", "a scene file");
    keys_.text("name", scene_.name, "a name in quotes");
    read_shape();
    read_springs();
    read_pins();
    read_node();
    read_start();
    read_motion();
    read_probe();
    read_incremental();
    read_relax();
    read_force();
    keys_.refuse_unknown();
    check_shape();
    check_law();
    check_start();
    return scene_;
  }

 private:
  input::InputError error(const std::string& key, const std::string& expected) const {
    return source_.error(*source_.find(key), key, expected);
  }

  void read_shape() {
    MeshSpec& mesh = scene_.mesh;
    Grid grid;
    keys_.integer("mesh.grid.rows", grid.rows, 1, int(most_nodes));
    keys_.integer("mesh.grid.columns", grid.columns, 1, int(most_nodes));
    keys_.real("mesh.grid.pitch", grid.pitch, input::above_zero);
    const input::TomlValue* table = source_.find("mesh.grid");
    if (table && table->as<input::TomlTable>()) mesh.grid = grid;
    std::string file;
    if (keys_.text("mesh.file", file, "the path of an OBJ file"))
      mesh.file = resolved(file, scene_.source, scene_.lines["mesh.file"] == 0);
    keys_.real("mesh.scale", mesh.scale, input::above_zero);
    keys_.real("mesh.pin_band", mesh.pin_band, input::zero_to_one);
    keys_.choice("mesh.up", mesh.up, {"x", "y", "z"});
  }

  void read_springs() {
    MeshSpec& mesh = scene_.mesh;
    if (mesh.file) mesh.shear = mesh.bend = 0; // the edges of a file are all alike
    keys_.real("mesh.springs.structural", mesh.structural, input::from_zero);
    keys_.real("mesh.springs.shear", mesh.shear, input::from_zero);
    keys_.real("mesh.springs.bend", mesh.bend, input::from_zero);
    std::string law = "linear";
    keys_.choice("mesh.springs.law", law, {"linear", "tension"});
    mesh.law = law == "tension" ? SpringLaw::tension : SpringLaw::linear;
    double floor = 0;
    if (keys_.real("mesh.springs.floor", floor, input::above_zero)) mesh.floor = floor;
  }

  void read_pins() {
    read_pin_ball();
    const input::TomlValue* found = keys_.value("mesh.pinned");
    if (!found) return;
    if (const auto* items = found->as<std::vector<input::TomlValue>>())
      for (const input::TomlValue& item : *items)
        scene_.mesh.pinned.push_back(read_pin(source_, item, "mesh.pinned"));
    else
      scene_.mesh.pinned = {read_pin(source_, *found, "mesh.pinned")};
  }

  void read_pin_ball() {
    PinBall ball;
    keys_.vector("mesh.pin_ball.centre", ball.centre);
    const bool sized = keys_.real("mesh.pin_ball.radius", ball.radius, input::above_zero);
    const input::TomlValue* table = source_.find("mesh.pin_ball");
    if (!table || !table->as<input::TomlTable>()) return;
    if (!sized)
      throw input::input_error(source_.file_of(table->line), table->line, "mesh.pin_ball", "no radius",
                               "{ centre = [x, y, z], radius = a length above 0 }");
    scene_.mesh.pin_ball = ball;
  }

  void read_node() {
    MeshSpec& mesh = scene_.mesh;
    keys_.real("mesh.mass", mesh.mass, input::above_zero);
    keys_.flag("mesh.planar", mesh.planar);
    const input::TomlValue* rest = keys_.value("mesh.rest");
    if (!rest) return;
    const auto* word = rest->as<std::string>();
    if (word && *word == "natural") return;
    constexpr input::Range length{0, 1e15, "\"natural\" or a length from 0 to 1e15"};
    if (word) throw source_.error(*rest, "mesh.rest", length.words, input::nearest_name(*word, {"natural"}));
    mesh.rest = keys_.number(*rest, "mesh.rest", length);
  }

  void read_start() {
    Start& start = scene_.mesh.start;
    keys_.real("mesh.start.shuffle", start.shuffle, input::from_zero);
    keys_.integer("mesh.start.seed", start.seed, 0, std::numeric_limits<std::int64_t>::max());
    keys_.vector("mesh.start.velocity", start.velocity);
  }

  void read_motion() {
    MotionSpec& motion = scene_.motion;
    std::string formulation = "probe";
    keys_.choice("motion.formulation", formulation, {"probe", "incremental"});
    motion.formulation = formulation == "probe" ? Formulation::probe : Formulation::incremental;
    keys_.real("motion.time_step", motion.time_step, input::above_zero);
    keys_.integer("motion.steps", motion.steps, 1, most_count);
    keys_.real("motion.friction", motion.friction, input::zero_to_one);
  }

  void read_probe() {
    ProbeSpec& probe = scene_.probe;
    keys_.real("probe.gamma", probe.gamma, input::from_zero);
    keys_.real("probe.beta", probe.beta, input::from_zero);
    keys_.real("probe.acceleration_memory", probe.acceleration_memory, input::zero_to_one);
    keys_.choice("probe.energy_springs", probe.energy_springs, {"own", "all"});
    keys_.choice("probe.force_on", probe.force_on, {"velocity", "acceleration"});
  }

  void read_incremental() {
    keys_.choice("incremental.rule", scene_.incremental.rule, {"backward_euler", "bdf2", "static"});
  }

  void read_relax() {
    keys_.real("relax.threshold", scene_.relax.threshold, input::from_zero);
    keys_.integer("relax.max_sweeps", scene_.relax.max_sweeps, 1, most_count);
    keys_.integer("relax.expansions", scene_.relax.expansions, 1, 1000);
  }

  void read_force() {
    keys_.vector("force.gravity", scene_.force.gravity);
    Vector3 wind{};
    if (keys_.vector("force.wind", wind)) scene_.force.wind = wind;
    keys_.real("force.drag", scene_.force.drag, input::from_zero);
    read_image();
  }

  void read_image() {
    ImageSpec image;
    const bool named = keys_.text("force.image.file", image.file, "the path of a PGM or PNG picture");
    keys_.real("force.image.pitch", image.pitch, input::above_zero);
    keys_.real("force.image.strength", image.strength, input::from_zero);
    keys_.real("force.image.smoothing", image.smoothing, {0.5, 50, "a number of pixels from 0.5 to 50"});
    const input::TomlValue* table = source_.find("force.image");
    if (!named && table && table->as<input::TomlTable>())
      throw input::input_error(source_.file_of(table->line), table->line, "force.image", "no file",
                               "file = a PGM or PNG picture");
    if (!named) return;
    if (scene_.motion.formulation == Formulation::probe)
      throw error("force.image.file", "formulation = \"incremental\" where an image pulls");
    image.file = resolved(image.file, scene_.source, scene_.lines["force.image.file"] == 0);
    scene_.force.image = image;
  }

  void check_law() const {
    const MeshSpec& mesh = scene_.mesh;
    if (mesh.law == SpringLaw::linear && mesh.floor)
      throw error("mesh.springs.floor", "this key only beside law = \"tension\"");
    if (mesh.law == SpringLaw::tension && mesh.rest.value_or(0) != 0)
      throw error("mesh.rest", "none beside law = \"tension\", which pulls alike at any length");
  }

  void check_start() const {
    const Vector3& v = scene_.mesh.start.velocity;
    if (v != Vector3{0, 0, 0} && scene_.is_static())
      throw error("mesh.start.velocity",
                  "none with incremental.rule = \"static\": nothing there has a speed");
    if (v[1] != 0 && scene_.mesh.planar)
      throw error("mesh.start.velocity", "0 along y in a planar mesh: y never moves");
  }

  void check_shape() const {
    const MeshSpec& mesh = scene_.mesh;
    if (mesh.grid && mesh.file) throw error("mesh.file", "either mesh.grid or mesh.file, not both");
    if (!mesh.grid && !mesh.file)
      throw input::input_error(scene_.source, 0, "mesh", "no shape",
                               "mesh.grid = { rows, columns, pitch } or mesh.file");
    if (mesh.grid)
      check_grid(*mesh.grid);
    else
      check_file();
  }

  void check_grid(const Grid& grid) const {
    const std::int64_t nodes = std::int64_t{grid.rows} * grid.columns;
    if (nodes < 2 || nodes > most_nodes)
      throw scene_error(scene_, "mesh.grid", fmt::format("{} x {} nodes", grid.rows, grid.columns),
                        fmt::format("2 to {} nodes", most_nodes));
    for (const char* key : {"mesh.scale", "mesh.pin_band", "mesh.up"}) // they would have no effect
      if (source_.find(key)) throw error(key, "this key only beside mesh.file");
  }

  void check_file() const {
    if (scene_.mesh.shear != 0)
      throw error("mesh.springs.shear", "0: edges of a mesh file are structural springs");
    if (scene_.mesh.bend != 0)
      throw error("mesh.springs.bend", "0: edges of a mesh file are structural springs");
  }

  const input::TomlSource& source_;
  input::KeyReader keys_;
  Scene scene_;
};

} // namespace

void override_scene(input::TomlSource& source, const std::string& key, const std::string& text) {
  if (key == "mesh.file")
    for (const char* of_grid : {"mesh.grid", "mesh.springs.shear", "mesh.springs.bend"})
      source.erase(of_grid);
  if (key == "mesh.grid" || starts_with(key, "mesh.grid."))
    for (const char* of_file : {"mesh.file", "mesh.scale", "mesh.pin_band", "mesh.up"}) source.erase(of_file);
  source.set(key, text);
}

Scene read_scene(const input::TomlSource& source, const std::string& path) {
  return SceneReader(source, path).read();
}

input::InputError scene_error(const Scene& scene, const std::string& key, const std::string& found,
                              const std::string& expected, const std::string& nearest) {
  const auto place = scene.lines.find(key);
  if (place == scene.lines.end()) return input::input_error(scene.source, 0, key, found, expected, nearest);
  return input::input_error(place->second == 0 ? "--set" : scene.source, place->second, key, found, expected,
                            nearest);
}

} // namespace hopmesh::scene
