#include "sim/run/run_files.h"

#include "sim/levels/image_force.h"
#include "sim/pictures/gltf.h"
#include "sim/pictures/mesh_picture.h"
#include "sim/pictures/overlay.h"
#include "sim/pictures/report.h"
#include "sim/run/array_info.h"
#include "sim/run/run_picture.h"
#include "sim/run/run_timeline.h"
#include "version.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

namespace hopmesh::run {

using Json = nlohmann::ordered_json;
using levels::Subject;

namespace {

// Fails before the first step, not after the last: the folder, and room for what will be written there.
std::filesystem::path ready(const std::filesystem::path& folder, const RunFacts& facts,
                            const levels::BuiltMesh& mesh, std::uint64_t done) {
  const std::uint64_t a_step =
      mesh.nodes() * (24 + (facts.level->has_codes() ? 4 * mesh.components() : 0)) + 300;
  files::check_writable(folder,
                        a_step * (static_cast<std::uint64_t>(facts.inputs.scene.motion.steps) - done + 1) +
                            mesh.nodes() * 8192 + (4u << 20));
  return folder;
}

std::optional<files::GreyPicture> image_of(const scene::Scene& scene) {
  return scene.force.image ? std::optional(levels::picture_of(scene)) : std::nullopt;
}

/// What is no UTF-8 (a folder's name in a command, at most) is replaced, as the report does.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// As JSON, piece by piece from the rows on the disk: there may be millions.
void write_hashes(const std::filesystem::path& table, const std::function<void(std::string_view)>& write) {
  std::ifstream file(table, std::ios::binary);
  std::string line, before = "[";
  std::getline(file, line); // the header
  for (; std::getline(file, line); before = ",")
    write(fmt::format("{}\n    \"{}\"", before, line.substr(line.rfind(',') + 1)));
  write(before == "[" ? "[]" : "\n  ]");
}

/// The colour of the report's pill in a word.
const char* status_of(const RunResult& result) {
  if (result.outcome == Outcome::diverged) return "bad";
  return result.rows.unrest().unrested > 0 ? "doubtful" : "good";
}

/// Where the run's time went. Of a host that nobody counts it is said that nobody knows.
void add_timeline(Json& json, const machine::Timeline& t, double clock_mhz) {
  const machine::HardwareTime time = t.time();
  json["hardware_seconds"] = time.seconds(clock_mhz);
  json["utilisation"] = t.utilisation();
  json["utilisation_with_bus"] = t.utilisation_with_bus();
  json["timeline"] = {{"bus", t.bus},
                      {"array_prepare", t.prepare},
                      {"array_sweeps", t.sweeps},
                      {"array_waits_for_bus", time.bus_cycles},
                      {"bus_waits_for_array", time.array_cycles},
                      {"host_with_both_idle", nullptr}};
  if (t.host_seconds) json["timeline"]["host_with_both_idle"] = *t.host_seconds * clock_mhz * 1e6;
}

void add_totals(Json& json, levels::Subject subject, const StepLog& rows) {
  for (const RunTotal& t : totals_about(subject, rows))
    json[t.total->key] = t.is_count ? Json(static_cast<std::uint64_t>(t.value)) : Json(t.value);
}

/// An emulated host: what it was, and where its instructions went.
Json host_json(const scene::HostSpec& host, const levels::HostCounts& counts, const StepLog& rows,
               std::optional<double> seconds) {
  Json json{{"core", name_of(host.core)},          {"cpi", host.cpi},
            {"clock_mhz", host.clock_mhz},         {"seconds", seconds.value_or(0)},
            {"memory_bytes", counts.memory_bytes}, {"functions", Json::array()}};
  add_totals(json, Subject::host, rows);
  for (const levels::HostFunction& f : counts.functions)
    json["functions"].push_back(
        {{"name", f.name}, {"instructions", f.instructions}, {"with_library", f.with_library}});
  return json;
}

} // namespace

RunFiles::RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
                   const levels::Mover& motion)
    : folder_(ready(folder, facts, mesh, 0)), facts_(facts), mesh_(mesh),
      mesh_hash_(run::mesh_hash(mesh.mesh())), image_(image_of(facts.inputs.scene)), lock_(folder),
      positions_(folder / "positions.npy", place_shape()), table_(folder / "steps.csv", step_header()) {
  if (facts.level->has_codes()) outputs_.emplace(folder / "outputs_raw.npy", code_shape());
  positions_.append(motion.positions());
}

RunFiles::RunFiles(const std::filesystem::path& folder, const RunFacts& facts, const levels::BuiltMesh& mesh,
                   RunStreams streams)
    : folder_(ready(folder, facts, mesh, streams.steps)), facts_(facts), mesh_(mesh),
      mesh_hash_(run::mesh_hash(mesh.mesh())), image_(image_of(facts.inputs.scene)),
      lock_(std::move(streams.lock)),
      positions_(folder / "positions.npy", place_shape(), std::move(streams.positions)),
      table_(folder / "steps.csv", step_header(), std::move(streams.table)) {
  if (streams.outputs)
    outputs_.emplace(folder / "outputs_raw.npy", code_shape(), std::move(*streams.outputs));
}

std::optional<std::uint64_t> RunFiles::image_hash() const {
  return image_ ? std::optional(picture_hash(*image_)) : std::nullopt;
}

void RunFiles::step(const levels::StepRow& row, const levels::Mover& motion) {
  positions_.append(motion.positions());
  if (outputs_) outputs_->append(motion.outputs_raw());
  write_row(table_, row);
}

std::vector<NamedMark> RunFiles::sync() {
  std::vector<NamedMark> marks{{"positions.npy", positions_.sync()}, {"steps.csv", table_.sync()}};
  if (outputs_) marks.push_back({"outputs_raw.npy", outputs_->sync()});
  return marks;
}

void RunFiles::finish(const RunResult& result, const levels::Mover& motion) {
  positions_.commit();
  if (outputs_)
    outputs_->commit();
  else // what an earlier run at a level with codes left here is not of this run
    discard("outputs_raw.npy");
  table_.commit();
  std::string told = write_manifest(result);
  files::write_file(folder_ / "stats.json",
                    statistics(result, motion)); // kept if the pictures cannot be written
  auto view = run_picture(facts_, mesh_, result, folder_ / "positions.npy", std::move(told));
  pictures::write_glb(view, folder_ / "mesh.glb");
  pictures::write_mesh_picture(view, folder_ / "picture.svg");
  if (image_)
    overlay(motion);
  else
    discard("overlay.svg");
  view.tables = run_tables(facts_, mesh_, result, motion.ranges());
  if (facts_.level->has_codes() && !result.rows.empty())
    view.drawings.push_back(timeline_drawing(facts_, mesh_, result.rows));
  if (facts_.level->has_codes())
    for (auto& table :
         array_info(facts_.inputs.scene, mesh_, facts_.inputs.array, typical_load(facts_, result.rows)))
      view.tables.push_back(table);
  pictures::write_report(report_view(std::move(view)), folder_ / "report.html");
  files::write_file(folder_ / "stats.json", statistics(result, motion)); // now it knows the peak memory
  if (result.outcome == Outcome::interrupted) return;
  discard(checkpoint_name); // last: until here a killed run can be resumed
}

// Springs as they were and as they came to lie, over the picture that pulled them.
void RunFiles::overlay(const levels::Mover& motion) const {
  const scene::Scene& scene = facts_.inputs.scene;
  std::vector<pictures::OverlayLine> start, end;
  for (const scene::Spring& s : mesh_.mesh().springs) {
    const auto pixel = [&](const double* place) { return levels::pixel_of(*scene.force.image, place); };
    const auto& was = mesh_.mesh().position;
    const double* is = motion.positions().data();
    start.push_back({pixel(was[s.node[0]].data()), pixel(was[s.node[1]].data())});
    end.push_back({pixel(is + 3 * s.node[0]), pixel(is + 3 * s.node[1])});
  }
  pictures::write_overlay(folder_ / "overlay.svg", *image_, start, end);
}

// The part first: a kill in between leaves no more than a kill before.
void RunFiles::discard(const std::string& name) const {
  std::error_code none;
  for (const char* part : {".part", ""}) std::filesystem::remove(folder_ / (name + part), none);
}

std::string RunFiles::statistics(const RunResult& result, const levels::Mover& motion) const {
  const StepLog& rows = result.rows;
  const double s = result.wall_seconds;
  const std::uint64_t updates = neuron_updates(rows, mesh_);
  const auto a_second = [s](std::uint64_t count) { return Json(s > 0 ? static_cast<double>(count) / s : 0); };
  Json json{{"scene", facts_.inputs.scene.name},     {"level", facts_.level->name},
            {"outcome", name_of(result.outcome)},    {"status", status_of(result)},
            {"sentence", result.sentence},           {"nodes", mesh_.nodes()},
            {"neurons", mesh_.topology().neurons()}, {"steps", rows.size()}};
  add_totals(json, Subject::relaxation, rows);
  if (!rows.empty() && rows.front().fall_left) add_totals(json, Subject::rest, rows);
  if (!rows.empty() && rows.front().fall_seen) add_totals(json, Subject::glance, rows);
  if (!rows.empty() && rows.front().residual) add_totals(json, Subject::correction, rows);
  json["neuron_updates"] = updates;
  json["wall_seconds"] = s;
  json["steps_per_second"] = a_second(rows.size());
  json["neuron_updates_per_second"] = a_second(updates);
  add_totals(json, Subject::motion, rows);
  json["peak_memory_mb"] = peak_memory_mb();
  if (facts_.level->has_codes()) {
    add_totals(json, Subject::clock, rows);
    add_timeline(json, timeline_of_run(facts_, mesh_, rows), facts_.inputs.array.clock_mhz);
    if (facts_.inputs.scene.host.counts())
      json["host"] = host_json(facts_.inputs.scene.host, motion.host_counts(), rows,
                               timeline_of_run(facts_, mesh_, rows).host_seconds);
    json["simulated_cycles_per_second"] =
        a_second(count_of(rows, &levels::StepRow::cycles, levels::Summary::sum));
    add_totals(json, Subject::network, rows);
    json["against_reference"] = nullptr;
    if (is_judged(rows)) add_totals(json["against_reference"], Subject::reference, rows);
    if (!rows.empty() && rows.front().told_error)
      add_totals(json["against_reference"], Subject::certainty, rows);
    if (is_judged(rows) && rows.front().host_error)
      add_totals(json["against_reference"], Subject::arithmetic, rows);
    for (const levels::SignalRange& r : motion.ranges())
      json["ranges"].push_back({{"signal", r.signal},
                                {"format", r.format.text()},
                                {"least_raw", r.least},
                                {"largest_raw", r.largest},
                                {"least", std::ldexp(double(r.least), -r.format.fraction_bits())},
                                {"largest", std::ldexp(double(r.largest), -r.format.fraction_bits())}});
  }
  return text_of(json);
}

// What the report tells of it: without the hashes of more steps than it draws.
std::string RunFiles::write_manifest(const RunResult& result) const {
  const std::string head = manifest_head(result) + ",\n  \"step_hashes\": ", end = "\n}\n";
  const bool all = result.rows.size() <= most_points;
  std::string told = head;
  files::OutputFile file(folder_ / "manifest.json");
  file.write(head);
  write_hashes(folder_ / "steps.csv", [&](std::string_view text) {
    file.write(text);
    if (all) told += text;
  });
  file.write(end);
  file.commit();
  return told + (all ? end : "\"in manifest.json\"" + end);
}

std::string RunFiles::manifest_head(const RunResult& result) const {
  Json json{
      {"program", "hopmesh"},
      {"version", version},
      {"commit", commit},
      {"compiler", compiler},
      {"build_type", build_type},
      {"command",
       facts_.command + (facts_.asked_steps > 0 ? fmt::format(" --steps {}", facts_.asked_steps) : "")},
      {"level", facts_.level->name},
      {"seed", nullptr}, // nothing in a run is drawn at random
      {"outcome", name_of(result.outcome)},
      {"scene", scene::scene_text(facts_.inputs.scene)},
      {"array", facts_.level->has_codes() ? Json(input::array_text(facts_.inputs.array)) : Json(nullptr)},
      {"mesh_hash", fmt::format("{:016x}", mesh_hash_)},
      {"image_hash", image_ ? Json(fmt::format("{:016x}", *image_hash())) : Json(nullptr)}};
  const std::string text = text_of(json);
  return text.substr(0, text.size() - 3);
}

} // namespace hopmesh::run
