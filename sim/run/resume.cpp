#include "sim/run/resume.h"

#include "sim/files/npy.h"
#include "sim/levels/image_force.h"
#include "sim/levels/level.h"
#include "sim/run/step_table.h"

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace hopmesh::run {

namespace {

namespace fs = std::filesystem;

/// How the run in a folder without a checkpoint ended, if it did.
std::string ending_of(const fs::path& folder) {
  std::ifstream file(folder / "manifest.json");
  const auto manifest = nlohmann::json::parse(file, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("outcome") || !manifest["outcome"].is_string()) return "";
  return manifest["outcome"];
}

void expect_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / checkpoint_name, ignored)) return;
  const std::string ending = ending_of(folder);
  throw input::input_error(
      (folder / checkpoint_name).string(), 0, "",
      ending.empty() ? "no such file" : "no such file: the run here has " + ending,
      "the results folder of a run that was interrupted, or killed with --checkpoint-every");
}

scene::Inputs inputs_in(const Checkpoint& c) {
  return scene::inputs_of({c.scene, c.line.at("scene")}, {c.array, c.line.at("array")}, c.file);
}

void expect_mesh(const Checkpoint& c, const scene::Inputs& inputs, const levels::BuiltMesh& mesh) {
  const std::uint64_t hash = mesh_hash(mesh.mesh());
  if (hash == c.mesh) return;
  throw c.error("mesh", fmt::format("{:016x}", c.mesh),
                fmt::format("{:016x}: {} has changed", hash, inputs.scene.mesh.file.value_or("the grid")));
}

void expect_image(const Checkpoint& c, const scene::Scene& scene) {
  if (!scene.force.image) return;
  const std::uint64_t hash = picture_hash(levels::picture_of(scene));
  if (hash == c.image) return;
  throw c.error("image", c.image ? fmt::format("{:016x}", *c.image) : "no line",
                fmt::format("{:016x}: {} has changed", hash, scene.force.image->file));
}

// An array's outputs stand cell by cell, the reference's node by node; a rival has neither outputs nor
// accelerations.
std::size_t outputs_of(levels::Kind kind, const levels::BuiltMesh& mesh) {
  if (kind == levels::Kind::rival) return 0;
  return (kind == levels::Kind::array ? mesh.cells() : mesh.nodes()) * mesh.components();
}

void expect_state(const Checkpoint& c, const levels::Level& level, const levels::BuiltMesh& mesh) {
  const auto expect = [&](const char* name, const std::vector<double>& values, std::size_t wanted) {
    if (values.size() != wanted)
      throw c.error(name, fmt::format("{} values", values.size()), fmt::format("{}", wanted));
  };
  expect("position", c.state.position, 3 * mesh.nodes());
  expect("velocity", c.state.velocity, 3 * mesh.nodes());
  expect("acceleration", c.state.acceleration, level.kind == levels::Kind::rival ? 0 : 3 * mesh.nodes());
  expect("output", c.state.output, outputs_of(level.kind, mesh));
}

files::StreamRest find(const Checkpoint& c, const fs::path& folder, const std::string& name,
                       const std::string& head) {
  const auto named =
      std::find_if(c.streams.begin(), c.streams.end(), [&](const NamedMark& s) { return s.name == name; });
  if (named == c.streams.end()) throw c.error("stream", "no line for " + name, "one");
  std::string found;
  auto rest = files::find_rest(folder / name, named->mark, head, found);
  if (!rest)
    throw c.error(name, found,
                  fmt::format("the {} bytes with check {:016x} that were written", named->mark.bytes,
                              named->mark.check));
  return std::move(*rest);
}

template <class T>
void expect_rows(const Checkpoint& c, const char* name, const files::StreamRest& rest, std::size_t rows,
                 std::size_t row_size) {
  const std::size_t wanted = rest.head.size() + rows * row_size * sizeof(T);
  if (rest.bytes != wanted)
    throw c.error(name, fmt::format("{} bytes", rest.bytes),
                  fmt::format("{} bytes of {} rows", wanted, rows));
}

RunStreams streams_of(const Checkpoint& c, const levels::Level& level, const fs::path& folder,
                      const levels::BuiltMesh& mesh, files::FolderLock lock) {
  const std::vector<std::size_t> place{mesh.nodes(), 3}, codes{mesh.nodes(), mesh.components()};
  RunStreams streams{std::move(lock), find(c, folder, "positions.npy", files::NpyWriter<double>::head(place)),
                     find(c, folder, "steps.csv", ""), std::nullopt, c.state.step};
  expect_rows<double>(c, "positions.npy", streams.positions, c.state.step + 1, 3 * mesh.nodes());
  if (!level.has_codes()) return streams;
  streams.outputs = find(c, folder, "outputs_raw.npy", files::NpyWriter<std::int32_t>::head(codes));
  expect_rows<std::int32_t>(c, "outputs_raw.npy", *streams.outputs, c.state.step,
                            mesh.nodes() * mesh.components());
  return streams;
}

/// The last row holds the hash of the state: table and checkpoint prove each other.
StepLog rows_of(const Checkpoint& c, const RunStreams& streams) {
  StepLog rows;
  each_row(streams.table.found, streams.table.bytes, step_columns(),
           [&](const levels::StepRow& row) { rows.push_back(row); });
  if (rows.size() != c.state.step)
    throw c.error("steps.csv", fmt::format("{} rows", rows.size()), fmt::format("{}", c.state.step));
  const levels::StepState& s = c.state;
  const std::uint64_t hash = levels::state_hash(s);
  if (!rows.empty() && rows.back().hash != hash)
    throw c.error("steps", fmt::format("a state with hash {:016x}", hash),
                  fmt::format("{:016x}, as in steps.csv", rows.back().hash));
  return rows;
}

} // namespace

ResumedRun read_run(const fs::path& folder) {
  files::FolderLock lock(folder); // first: what is read stays as it is
  expect_checkpoint(folder);
  Checkpoint saved = read_checkpoint(folder / checkpoint_name);
  scene::Inputs inputs = inputs_in(saved);
  auto mesh = std::make_unique<levels::BuiltMesh>(inputs.scene);
  expect_mesh(saved, inputs, *mesh);
  expect_image(saved, inputs.scene);
  const levels::Level& level = levels::level_named(saved.level, saved.file);
  expect_state(saved, level, *mesh);
  RunStreams streams = streams_of(saved, level, folder, *mesh, std::move(lock));
  auto rows = rows_of(saved, streams);
  return {std::move(saved), std::move(inputs), std::move(mesh), std::move(rows), std::move(streams)};
}

} // namespace hopmesh::run
