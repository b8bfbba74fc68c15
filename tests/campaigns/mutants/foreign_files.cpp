#include "place.h"
#include "sim/cosim/level_vectors.h"
#include "sim/input/line_reader.h"
#include "sim/input/presets.h"
#include "sim/levels/image_force.h"
#include "sim/levels/level.h"
#include "sim/levels/networks/given_network.h"
#include "sim/networks/network_files.h"
#include "sim/study/study_points.h"
#include "tests/campaigns/mutants/reader.h"
#include "tests/campaigns/mutants/repairs.h"
#include "tests/support/files.h"

#include <algorithm>
#include <stdexcept>

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;
using tests::content_of;
using tests::write_text;

const fs::path tree = HOPMESH_SOURCE_DIR;

/// Meshes of more nodes are right, and take a while.
constexpr std::int64_t few_nodes = 5000;

bool is_small(const scene::Scene& scene) {
  const auto& grid = scene.mesh.grid;
  return !grid || std::int64_t{grid->rows} * grid->columns <= few_nodes;
}

void read_scene(const fs::path& folder) {
  const scene::Inputs inputs = scene::read_inputs((folder / "m.toml").string(), "", {});
  const std::string text = scene::scene_text(inputs.scene);
  try {
    scene::inputs_of({text}, {input::array_text(inputs.array)}, (folder / "m.toml").string());
  } catch (const input::InputError& why) {
    throw std::logic_error(std::string("its own text is refused: ") + why.what());
  }
  if (is_small(inputs.scene)) levels::prepare((folder / "m.toml").string(), "", {});
}

void read_array(const fs::path& folder) {
  const std::string path = (folder / "m.toml").string();
  std::vector<std::string> notes;
  const std::string text = input::array_text(input::read_array(path, {}, notes));
  try {
    input::array_of(input::TomlSource::of_text(text, path), path);
  } catch (const input::InputError& why) {
    throw std::logic_error(std::string("its own text is refused: ") + why.what());
  }
}

void read_study(const fs::path& folder) {
  const study::Study found = study::read_study((folder / "m.toml").string());
  for (std::size_t n = 0; n < std::min<std::size_t>(found.combinations(), 10); ++n)
    study::inputs_of(found, study::point_of(found, n));
}

void read_overrides(const fs::path& folder) {
  const std::string text = content_of(folder / "m.txt");
  std::vector<std::string> overrides;
  for (input::LineReader lines(text); lines.next();) overrides.emplace_back(lines.line());
  scene::read_inputs("two-nodes", "", overrides);
}

// Every second one is welded, its loose vertices kept.
void read_mesh(const fs::path& folder) {
  std::vector<std::string> choices;
  if (fs::file_size(folder / "m.obj") % 2) choices = {"mesh.weld=true", "mesh.loose=keep"};
  levels::prepare((folder / "scene.toml").string(), "", choices);
}

void read_picture(const fs::path& folder) {
  const scene::Inputs inputs = scene::read_inputs((folder / "scene.toml").string(), "", {});
  const levels::ImageForce force(inputs.scene);
}

/// W in `weights`, I in `bias`, both of them judged.
void read_network(const std::string& weights, const std::string& bias, bool asymmetric) {
  const networks::NetworkFiles files{weights, bias, "", asymmetric};
  const networks::NetworkData data = networks::read_network(files);
  if (data.W.rows <= 10'000) const levels::GivenNetwork network(data, 0.0);
}

void read_matrix(const fs::path& folder) {
  const std::string place = (folder / "m.mtx").string();
  read_network(place, "", fs::file_size(place) % 2 > 0);
}

void read_bias(const fs::path& folder) {
  read_network((folder / "W.mtx").string(), (folder / "m.mtx").string(), false);
  networks::read_start((folder / "m.mtx").string(), 3);
}

/// A case may ask for more sweeps than anybody waits for.
bool is_short(const std::string& path) {
  cosim::VectorCase a_case;
  bool all = true;
  for (cosim::VectorReader reader(path); reader.next(a_case);)
    all = all && a_case.job.max_sweeps <= 1000 && a_case.job.topology.cells() < 1000;
  return all;
}

void read_vectors(const fs::path& folder) {
  const std::string path = (folder / "m.txt").string();
  if (is_short(path)) cosim::judge_vectors(path, levels::default_level());
}

Seeds seeds_of_vectors(const fs::path& made) {
  Seeds seeds;
  const std::string path = (made / "vectors.txt").string();
  for (const levels::Level* level : {&levels::default_level(), static_cast<const levels::Level*>(nullptr)})
    for (std::uint64_t first : {2, 5}) {
      cosim::write_vectors(
          path, 2, [first](std::uint64_t k) { return cosim::random_case(first + k); }, level);
      if (fs::file_size(path) < 40'000) seeds.push_back(content_of(path));
    }
  return seeds;
}

fs::path folder_with(const fs::path& folder, const std::string& name, const std::string& text) {
  fs::create_directories(folder);
  write_text(folder / name, text);
  return folder;
}

/// A scene's own files have plain names beside it.
fs::path shipped_scenes(const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& entry : fs::directory_iterator(tree / "sim/scenes"))
    if (entry.path().extension() != ".toml") fs::copy_file(entry.path(), folder / entry.path().filename());
  return folder;
}

Seeds joined(Seeds some, const Seeds& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

Seeds presets() {
  Seeds texts;
  std::vector<std::string> notes;
  for (const input::PresetWords& preset : input::preset_words())
    texts.push_back(input::array_text(input::read_array(preset.name, {}, notes)));
  return texts;
}

const std::string small_matrix = "%%MatrixMarket matrix coordinate real symmetric\n3 3 2\n2 1 -1\n3 2 0.5\n";
const std::string mesh_scene = "[mesh]\nfile = \"m.obj\"\npinned = [0]\n";
std::string image_scene(const std::string& file) {
  std::string text = content_of(tree / "sim/scenes/snake.toml");
  const std::string shipped = "snake.pgm";
  return text.replace(text.find(shipped), shipped.size(), file);
}

fs::path picture_folder(const fs::path& folder, const std::string& file) {
  fs::create_directories(folder);
  fs::copy_file(tree / "sim/scenes/snake.obj", folder / "snake.obj");
  return folder_with(folder, "scene.toml", image_scene(file));
}

} // namespace

std::vector<Reader> readers_of_foreign_files(const fs::path& made) {
  const fs::path seeds = tree / "tests/campaigns/seeds", scenes = shipped_scenes(made / "scenes");
  const Seeds tables =
      joined(contents_of(tree / "sim/scenes", ".toml"), contents_of(tree / "tests/scene/good", ".toml"));
  const Seeds arrays = joined(presets(), contents_of(tree / "tests/scene/good", ".toml"));
  const Seeds pictures = joined(contents_of(seeds, ".pgm"), contents_of(tree / "sim/scenes", ".pgm"));
  return {
      {"scene", "m.toml", tables, scenes, read_scene},
      {"array", "m.toml", arrays, "", read_array},
      {"study", "m.toml", contents_of(tree / "sim/studies", ".toml"), "", read_study},
      {"overrides", "m.txt", contents_of(seeds, ".set"), "", read_overrides},
      {"mesh", "m.obj", joined(contents_of(seeds, ".obj"), contents_of(tree / "tests/scene/good", ".obj")),
       folder_with(made / "mesh", "scene.toml", mesh_scene), read_mesh},
      {"png", "m.png", contents_of(seeds, ".png"), picture_folder(made / "png", "m.png"), read_picture,
       repair_png},
      {"pgm", "m.pgm", pictures, picture_folder(made / "pgm", "m.pgm"), read_picture},
      {"matrix", "m.mtx", contents_of(seeds / "matrices", ".mtx"), "", read_matrix},
      {"bias", "m.mtx", contents_of(seeds / "biases", ".mtx"),
       folder_with(made / "bias", "W.mtx", small_matrix), read_bias},
      {"vectors", "m.txt", seeds_of_vectors(made), "", read_vectors},
  };
}

std::vector<Reader> all_readers(const fs::path& made) {
  std::vector<Reader> all = readers_of_foreign_files(made);
  for (auto more : {readers_of_kept_files, readers_of_stopped_runs})
    for (Reader& reader : more(made)) all.push_back(std::move(reader));
  return all;
}

const Reader& reader_named(const std::vector<Reader>& readers, const std::string& name) {
  for (const Reader& reader : readers)
    if (reader.name == name) return reader;
  throw std::out_of_range("no reader is called " + name);
}

Seeds contents_of(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ending) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  Seeds seeds;
  for (const fs::path& path : paths) seeds.push_back(content_of(path));
  return seeds;
}

} // namespace hopmesh::campaigns
