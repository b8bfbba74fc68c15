#include "sim/run/run_picture.h"

#include "sim/run/array_info.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

void add_surface(const scene::Mesh& mesh, pictures::RunView& view) {
  view.nodes = mesh.nodes();
  view.pinned = mesh.pinned;
  view.triangles.reserve(mesh.triangles.size());
  view.springs.reserve(mesh.springs.size());
  for (const auto& t : mesh.triangles) {
    std::array<pictures::ViewCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {t[k].node, t[k].u, t[k].v};
    view.triangles.push_back(corners);
  }
  for (const auto& s : mesh.springs)
    view.springs.push_back({{s.node[0], s.node[1]}, static_cast<float>(s.rest_length)});
}

void add_frames(const std::filesystem::path& positions, double time_step, pictures::RunView& view) {
  files::NpyReader<double> file(positions);
  for (const std::size_t row : rows_shown(file.rows(), view.nodes)) {
    const auto values = file.row(row);
    view.frames.emplace_back(values.begin(), values.end());
    view.frame_steps.push_back(static_cast<double>(row));
    view.frame_times.push_back(static_cast<double>(row) * time_step);
  }
}

void add_series(const RunFacts& facts, const std::vector<levels::StepRow>& rows, pictures::RunView& view) {
  const auto add = [&](const char* name, const char* unit, auto value) {
    pictures::Series series;
    series.name = name;
    series.unit = unit;
    for (const levels::StepRow& row : rows) series.values.push_back(value(row));
    view.series.push_back(std::move(series));
  };
  for (const levels::StepRow& row : rows) view.step_times.push_back(row.time);
  const bool has_neurons = !rows.empty() && rows.front().sweeps > 0; // rivals have none
  if (has_neurons) add("sweeps a step", "", [](const levels::StepRow& r) { return double(r.sweeps); });
  if (facts.level->has_codes())
    add("array cycles a step", "", [](const levels::StepRow& r) { return double(r.cycles); });
  add("elastic energy", "J", [](const levels::StepRow& r) { return r.energy; });
  add("kinetic energy", "J", [](const levels::StepRow& r) { return r.kinetic; });
  add("largest strain", "%", [](const levels::StepRow& r) { return 100 * r.max_strain; });
  if (has_neurons)
    add("outputs at +1 or -1", "", [](const levels::StepRow& r) { return double(r.saturated); });
  if (rows.empty() || !rows.front().error) return;
  add("largest output error against the reference", "",
      [](const levels::StepRow& r) { return r.error->largest_output; });
  add("energy left above the reference's rest", "of its fall",
      [](const levels::StepRow& r) { return r.error->energy_gap; });
}

FigureTable run_table(const RunFacts& facts, const Totals& t, double seconds) {
  const auto rate = [&](double count) { return seconds > 0 ? count / seconds : 0.0; };
  FigureTable table{"Run", {}};
  auto& rows = table.second;
  rows.push_back({"level", facts.level->name});
  rows.push_back({"steps", grouped(t.steps)});
  rows.push_back({"wall time", fmt::format("{:.2f} s", seconds)});
  rows.push_back({"steps/s", fmt::format("{:.1f}", rate(static_cast<double>(t.steps)))});
  if (t.sweeps > 0) {
    rows.push_back({"sweeps", grouped(t.sweeps)});
    rows.push_back({"steps stopped by max_sweeps", grouped(t.unconverged)});
    rows.push_back({"neuron updates/s", fmt::format("{:.3g}", rate(static_cast<double>(t.updates)))});
  }
  if (facts.level->has_codes()) {
    const double hardware = static_cast<double>(t.cycles + t.bus_cycles) / facts.inputs.array.clock_mhz / 1e6;
    rows.push_back(
        {"simulated cycles", grouped(t.cycles) + " in the array, " + grouped(t.bus_cycles) + " on the bus"});
    rows.push_back({"simulated cycles/s", fmt::format("{:.3g}", rate(static_cast<double>(t.cycles)))});
    rows.push_back(
        {"time on hardware", fmt::format("{:.3g} s at {} MHz", hardware, facts.inputs.array.clock_mhz)});
  }
  rows.push_back({"largest strain", fmt::format("{:.1f} %", 100 * t.worst_strain)});
  rows.push_back({"peak memory", fmt::format("{:.0f} MB", t.peak_memory_mb)});
  return table;
}

FigureTable accuracy_table(const Totals& t) {
  return {"Against the double reference, step by step",
          {{"output error of a step", fmt::format("{:.3g} rms (median)", t.median_error)},
           {"energy left of a step's fall", fmt::format("{:.3g} (median)", t.median_energy_gap)},
           {"largest output error", fmt::format("{:.3g}", t.largest_error)},
           {"largest energy left", fmt::format("{:.3g} of a step's fall", t.worst_energy_gap)},
           {"largest weight or bias error", fmt::format("{:.2g} of the largest", t.largest_network_error)},
           {"weights and biases clipped", grouped(t.clipped)}}};
}

FigureTable range_table(const std::vector<levels::SignalRange>& ranges) {
  FigureTable table{"Codes seen", {}};
  for (const levels::SignalRange& r : ranges) {
    const double scale = std::exp2(-r.format.fraction_bits());
    const double reach =
        static_cast<double>(std::max(-r.least, r.largest)) / static_cast<double>(r.format.max_raw());
    table.second.push_back({r.signal, fmt::format("{:.4g} to {:.4g}, {:.0f} % of {}", double(r.least) * scale,
                                                  double(r.largest) * scale, 100 * reach, r.format.text())});
  }
  return table;
}

} // namespace

std::vector<std::size_t> rows_shown(std::size_t rows, std::size_t nodes) {
  const std::size_t frame_bytes = std::max<std::size_t>(1, 3 * sizeof(float) * nodes);
  const std::size_t room = std::clamp<std::size_t>(most_frame_bytes / frame_bytes, 2, most_frames);
  const std::size_t count = std::min(rows, room);
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < count; ++k) shown.push_back(count == 1 ? 0 : k * (rows - 1) / (count - 1));
  return shown;
}

std::vector<FigureTable> run_tables(const RunFacts& facts, const levels::BuiltMesh& mesh,
                                    const RunResult& result, const std::vector<levels::SignalRange>& ranges) {
  const Totals t = totals_of(result, mesh);
  std::vector<FigureTable> tables{run_table(facts, t, result.wall_seconds)};
  if (!result.rows.empty() && result.rows.front().error) tables.push_back(accuracy_table(t));
  if (!ranges.empty()) tables.push_back(range_table(ranges));
  return tables;
}

pictures::RunView run_picture(const RunFacts& facts, const levels::BuiltMesh& mesh, const RunResult& result,
                              const std::filesystem::path& positions, std::string manifest) {
  const scene::Scene& scene = facts.inputs.scene;
  pictures::RunView view;
  view.title = scene.name;
  view.subtitle = fmt::format("{} level, {} of {} steps of {} s{}", facts.level->name, result.rows.size(),
                              scene.motion.steps, scene.motion.time_step,
                              facts.level->has_codes() ? ", array " + facts.inputs.array.name : "");
  view.outcome = result.sentence;
  view.good = result.outcome != Outcome::diverged;
  view.crest = scene.mesh.grid.has_value();
  view.up = scene::axis_names[static_cast<std::size_t>(scene.mesh.up)];
  view.manifest = std::move(manifest);
  add_surface(mesh.mesh(), view);
  add_frames(positions, scene.motion.time_step, view);
  add_series(facts, result.rows, view);
  return view;
}

} // namespace hopmesh::run
