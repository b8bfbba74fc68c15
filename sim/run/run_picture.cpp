#include "sim/run/run_picture.h"

#include "sim/files/npy.h"
#include "sim/input/count_text.h"
#include "sim/pictures/coarse_view.h"
#include "sim/run/array_info.h"
#include "sim/run/run_timeline.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

using levels::Subject;

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
    auto& frame = view.frames.emplace_back();
    for (std::size_t k = 0; k < values.size(); ++k)
      frame.push_back(static_cast<float>(values[k] - view.origin[k % 3]));
    view.frame_steps.push_back(static_cast<double>(row));
    view.frame_times.push_back(static_cast<double>(row) * time_step);
  }
}

/// Rivals have no neurons, levels without codes no clock, and the reference is not always asked.
template <typename Rows> bool is_shown(levels::Subject subject, const RunFacts& facts, const Rows& rows) {
  switch (subject) {
  case Subject::motion:
    return true;
  case Subject::relaxation:
    return !rows.empty() && rows.front().sweeps > 0;
  case Subject::rest:
    return !rows.empty() && rows.front().fall_left.has_value();
  case Subject::glance:
    return !rows.empty() && rows.front().fall_seen.has_value();
  case Subject::correction:
    return !rows.empty() && rows.front().residual.has_value();
  case Subject::certainty:
    return !rows.empty() && rows.front().told_error.has_value();
  case Subject::clock:
  case Subject::network:
    return facts.level->has_codes();
  case Subject::arithmetic:
    return is_judged(rows) && facts.inputs.scene.host.arithmetic == scene::Arithmetic::fixed;
  case Subject::host:
    return facts.level->has_codes() && facts.inputs.scene.host.counts();
  case Subject::reference:
    return is_judged(rows);
  }
  return false;
}

void add_totals(levels::Subject subject, const StepLog& rows, std::vector<pictures::Figure>& lines) {
  for (const RunTotal& t : totals_about(subject, rows))
    if (t.total->name) lines.push_back({t.total->name, t.text()});
}

std::string hardware_text(const machine::HardwareTime& time, double mhz) {
  if (time.host_seconds)
    return fmt::format("{:.3g} s, {:.3g} % of it the host's; of array and bus, {:.0f} % on the bus",
                       time.seconds(mhz), 100 * time.host_share(mhz), 100 * time.bus_share());
  return fmt::format("{:.3g} s at {} MHz, {:.0f} % of it on the bus (the host's own part is not known)",
                     time.seconds(mhz), mhz, 100 * time.bus_share());
}

FigureTable run_table(const RunFacts& facts, const StepLog& rows, const levels::BuiltMesh& mesh,
                      double seconds) {
  const auto rate = [&](std::uint64_t count) {
    return seconds > 0 ? static_cast<double>(count) / seconds : 0.0;
  };
  FigureTable table{"Run", {}};
  auto& lines = table.second;
  lines.push_back({"level", facts.level->name});
  lines.push_back({"steps", input::grouped(rows.size())});
  lines.push_back({"wall time", fmt::format("{:.2f} s", seconds)});
  lines.push_back({"steps/s", fmt::format("{:.1f}", rate(rows.size()))});
  if (is_shown(Subject::relaxation, facts, rows)) {
    add_totals(Subject::relaxation, rows, lines);
    for (const Subject subject : {Subject::rest, Subject::glance, Subject::correction})
      if (is_shown(subject, facts, rows)) add_totals(subject, rows, lines);
    lines.push_back({"neuron updates/s", fmt::format("{:.3g}", rate(neuron_updates(rows, mesh)))});
  }
  if (is_shown(Subject::clock, facts, rows)) {
    const machine::Timeline timeline = timeline_of_run(facts, mesh, rows);
    const machine::HardwareTime time = timeline.time();
    lines.push_back({"simulated cycles", input::grouped(time.array_cycles) + " in the array, " +
                                             input::grouped(time.bus_cycles) + " on the bus"});
    lines.push_back({"simulated cycles/s", fmt::format("{:.3g}", rate(time.array_cycles))});
    lines.push_back({"time on hardware", hardware_text(time, facts.inputs.array.clock_mhz)});
    lines.push_back({"utilisation", utilisation_text(timeline)});
    add_totals(Subject::clock, rows, lines);
    if (is_shown(Subject::host, facts, rows)) add_totals(Subject::host, rows, lines);
  }
  add_totals(Subject::motion, rows, lines);
  if (const auto o = picture_origin(mesh.mesh()); o != std::array<double, 3>{0, 0, 0})
    lines.push_back({"pictures' origin", fmt::format("({}, {}, {}) m", o[0], o[1], o[2])});
  lines.push_back({"peak memory", fmt::format("{:.0f} MB", peak_memory_mb())});
  return table;
}

FigureTable accuracy_table(const RunFacts& facts, const StepLog& rows) {
  FigureTable table{"Against the double reference, step by step", {}};
  for (const Subject subject :
       {Subject::reference, Subject::arithmetic, Subject::certainty, Subject::network})
    if (is_shown(subject, facts, rows)) add_totals(subject, rows, table.second);
  return table;
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

std::array<double, 3> picture_origin(const scene::Mesh& mesh) {
  constexpr double far_off = 64; // extents: then single precision still keeps a 250,000th of the mesh
  double extent = 0, distance = 0;
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [least, most] =
        std::minmax_element(mesh.position.begin(), mesh.position.end(),
                            [k](const scene::Vector3& a, const scene::Vector3& b) { return a[k] < b[k]; });
    middle[k] = (*least)[k] / 2 + (*most)[k] / 2;
    extent = std::max(extent, (*most)[k] - (*least)[k]);
    distance = std::max(distance, std::fabs(middle[k]));
  }
  return distance > far_off * extent ? middle : std::array<double, 3>{0, 0, 0};
}

std::vector<std::size_t> rows_shown(std::size_t rows, std::size_t nodes) {
  const std::size_t frame_bytes = std::max<std::size_t>(1, 3 * sizeof(float) * nodes);
  const std::size_t room = std::clamp<std::size_t>(most_frame_bytes / frame_bytes, 2, most_frames);
  const std::size_t count = std::min(rows, room);
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < count; ++k) shown.push_back(count == 1 ? 0 : k * (rows - 1) / (count - 1));
  return shown;
}

std::size_t steps_a_point(const StepLog& rows) {
  const std::size_t least = std::max<std::size_t>(1, (rows.size() + most_points - 1) / most_points);
  return (least + rows.stride() - 1) / rows.stride() * rows.stride();
}

StepRows rows_drawn(const StepLog& rows) {
  StepRows drawn;
  const std::size_t stride = steps_a_point(rows) / rows.stride();
  for (std::size_t k = 0; k < rows.kept().size(); k += stride) drawn.push_back(rows.kept()[k]);
  if (!rows.empty() && drawn.back().step != rows.back().step) drawn.push_back(rows.back());
  return drawn;
}

pictures::RunView report_view(pictures::RunView view) {
  if (view.nodes <= most_report_nodes) return view;
  const std::size_t nodes = view.nodes;
  const double cubes =
      std::floor(std::sqrt(static_cast<double>(most_report_nodes))) - 1; // of a surface's side
  view = pictures::light_view(view, cubes);
  view.subtitle +=
      fmt::format("; its {} nodes are drawn as {}", input::grouped(nodes), input::grouped(view.nodes));
  return view;
}

std::vector<pictures::Series> series_of(const RunFacts& facts, const StepRows& rows,
                                        const StepColumns& columns) {
  std::vector<pictures::Series> all;
  for (const levels::StepColumn& column : columns) {
    if (!column.curve.name || !is_shown(column.subject, facts, rows)) continue;
    pictures::Series& series = all.emplace_back();
    series.name = column.curve.name, series.unit = column.curve.unit;
    for (const levels::StepRow& row : rows)
      series.values.push_back(column.curve.factor * value_of(row, column.figure).value_or(NAN));
  }
  return all;
}

std::vector<FigureTable> run_tables(const RunFacts& facts, const levels::BuiltMesh& mesh,
                                    const RunResult& result, const std::vector<levels::SignalRange>& ranges) {
  std::vector<FigureTable> tables{run_table(facts, result.rows, mesh, result.wall_seconds)};
  if (is_judged(result.rows)) tables.push_back(accuracy_table(facts, result.rows));
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
  view.rested = result.rows.unrest().unrested == 0;
  view.crest = scene.mesh.grid.has_value();
  view.up = scene::axis_names[static_cast<std::size_t>(scene.mesh.up)];
  view.manifest = std::move(manifest);
  add_surface(mesh.mesh(), view);
  view.origin = picture_origin(mesh.mesh());
  add_frames(positions, scene.motion.time_step, view);
  const StepRows drawn = rows_drawn(result.rows);
  for (const levels::StepRow& row : drawn) view.step_times.push_back(row.time);
  view.series = series_of(facts, drawn);
  if (drawn.size() < result.rows.size())
    view.subtitle += fmt::format("; charts show one step in {}", steps_a_point(result.rows));
  return view;
}

} // namespace hopmesh::run
