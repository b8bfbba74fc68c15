#include "sim/study/result_chart.h"

#include "sim/files/output_file.h"
#include "sim/input/count_text.h"
#include "sim/input/whole_file.h"
#include "sim/pictures/chart_page.h"
#include "sim/pictures/svg_chart.h"
#include "sim/study/chart_columns.h"
#include "sim/study/result_table.h"
#include "sim/study/spread.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;
using files::CsvTable;

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::size_t most_labels = 60; ///< of more marks, only the ends of ladders have labels

/// What is drawn of which table.
struct Choice {
  const CsvTable& table;
  const std::string &x, &y;
  const AxisColumns& axes;

  const std::string& cell(const PointGroup& group, std::size_t column) const {
    return table.rows[group.rows[0]][column];
  }
  const std::string& method(const PointGroup& group) const { return cell(group, axes.method); }
  /// The first row that says how the points failed, if all of them did.
  const std::size_t* failed(const PointGroup& group) const {
    if (!group.told.empty()) return nullptr;
    for (const std::size_t& row : group.rows)
      if (!is_finished(table, row) && table.number(row, y)) return &row;
    return nullptr;
  }
  bool is_drawn(const PointGroup& group) const { return !group.told.empty() || failed(group); }
};

std::string range_text(const Spread& spread) {
  return fmt::format("{:.4g} (from {:.4g} to {:.4g})", spread.median, spread.least, spread.largest);
}

std::string tip_of(const Choice& c, const PointGroup& group) {
  const bool one = c.axes.over.empty();
  const std::size_t row = group.rows[0];
  std::string tip =
      one ? fmt::format("point {}, {}", c.table.text(row, heading_of(&Point::number)), c.method(group))
          : fmt::format("{} of {} points, {}", group.told.size(), group.rows.size(), c.method(group));
  for (const std::size_t axis : c.axes.kept)
    tip += fmt::format("\n{} = {}", c.table.header[axis], c.cell(group, axis));
  if (!one && !group.told.empty())
    return tip + fmt::format("\n{}: {}\n{}: {}", c.x, range_text(group.x), c.y, range_text(group.y));
  return tip + fmt::format("\n{}: {}\n{}: {}\n{}, {}", c.x, c.table.text(row, c.x), c.y,
                           c.table.text(row, c.y), c.table.text(row, heading_of(&PointRow::outcome)),
                           c.table.text(row, heading_of(&PointRow::stability)));
}

pictures::ChartPoint point_of(const Choice& c, const PointGroup& group) {
  pictures::ChartPoint p;
  const std::size_t* failed = c.failed(group);
  p.failed = failed != nullptr;
  p.x = group.x.median;
  p.y = failed ? c.table.number(*failed, c.y).value_or(0) : group.y.median;
  p.across = {group.x.least, group.x.largest}, p.up = {group.y.least, group.y.largest};
  p.tip = tip_of(c, group);
  p.command = c.table.text(failed ? *failed : group.middle, heading_of(&Point::command));
  if (!c.axes.kept.empty()) p.label = c.cell(group, c.axes.kept.back());
  return p;
}

/// What the points of one ladder share: all but the last axis.
std::vector<std::string> ladder_of(const Choice& c, const PointGroup& group) {
  std::vector<std::string> shared{c.method(group)};
  for (std::size_t k = 0; k + 1 < c.axes.kept.size(); ++k) shared.push_back(c.cell(group, c.axes.kept[k]));
  return shared;
}

pictures::ChartSeries& series_named(pictures::Chart& chart, const std::string& name) {
  for (pictures::ChartSeries& s : chart.series)
    if (s.name == name) return s;
  return chart.series.emplace_back(pictures::ChartSeries{name, {}});
}

/// Crowded charts name only the ends of their ladders.
void thin_labels(std::size_t marks, pictures::Chart& chart) {
  if (marks <= most_labels) return;
  for (pictures::ChartSeries& series : chart.series)
    for (auto& ladder : series.ladders)
      for (std::size_t k = 1; k + 1 < ladder.size(); ++k) ladder[k].label.clear();
}

/// A mark for each group that is drawn, in the series that `name` gives it; returns how many.
template <class Name>
std::size_t add_marks(const Choice& c, const std::vector<PointGroup>& groups, bool squares,
                      pictures::Chart& chart, Name name) {
  std::map<std::vector<std::string>, std::size_t> ladders;
  std::size_t marks = 0;
  for (const PointGroup& group : groups) {
    if (!c.is_drawn(group)) continue;
    ++marks;
    pictures::ChartSeries& series = series_named(chart, name(group));
    series.squares = squares;
    const auto [place, fresh] = ladders.try_emplace(ladder_of(c, group), series.ladders.size());
    if (fresh) series.ladders.emplace_back();
    series.ladders[place->second].push_back(point_of(c, group));
  }
  return marks;
}

/// Beside integrators that have no hardware, an array stands with its time on hardware too.
std::size_t add_hardware(const Choice& c, pictures::Chart& chart) {
  const std::string hardware = heading_of(&PointRow::hardware_seconds);
  const Choice other{c.table, c.x, hardware, c.axes};
  const std::size_t marks =
      add_marks(other, groups_of(c.table, c.axes, c.x, hardware), true, chart,
                [&](const PointGroup& group) { return c.method(group) + ", on hardware"; });
  if (marks == 0) return 0;
  chart.keys = {"dots: time of a processor; of an", "array, that of emulating it",
                "squares: the array's cycles and the bus's,", "at the array's clock (hardware_seconds)"};
  return marks;
}

// A colour a method; where one only is drawn, a colour for each place of the first axis.
void add_series(const Choice& c, const std::vector<PointGroup>& groups, pictures::Chart& chart) {
  std::map<std::string, std::size_t> methods;
  for (const PointGroup& group : groups)
    if (c.is_drawn(group)) ++methods[c.method(group)];
  const bool one = methods.size() == 1 && c.axes.kept.size() > 1;
  std::size_t marks = add_marks(c, groups, false, chart, [&](const PointGroup& group) {
    return one ? c.table.header[c.axes.kept[0]] + ' ' + c.cell(group, c.axes.kept[0]) : c.method(group);
  });
  if (c.y == heading_of(&PointRow::host_seconds) && has_rivals(c.table)) marks += add_hardware(c, chart);
  thin_labels(marks, chart);
}

/// Whose points are not drawn, and why; points that failed within a group, too.
void add_notes(const Choice& c, const std::vector<PointGroup>& groups, pictures::Chart& chart) {
  std::map<std::pair<std::string, std::string>, std::size_t> missing;
  std::size_t within = 0;
  for (const PointGroup& group : groups) {
    const bool has_y = c.table.number(group.rows[0], c.y).has_value();
    if (!c.is_drawn(group)) missing[{c.method(group), has_y ? c.x : c.y}] += group.rows.size();
    if (!group.told.empty()) within += group.rows.size() - group.told.size();
  }
  for (const auto& [what, count] : missing)
    chart.notes.push_back(fmt::format("Not drawn: {} of {}, without {}", input::with_noun(count, "point"),
                                      what.first, what.second));
  if (within > 0)
    chart.notes.push_back(fmt::format("{} failed beside others of their mark and are in no median",
                                      input::with_noun(within, "point")));
  if (c.axes.over.empty()) return;
  std::vector<std::string> names;
  for (const std::size_t axis : c.axes.over) names.push_back(c.table.header[axis]);
  chart.notes.push_back(fmt::format(
      "A mark is the median over {}, its bars reach from the least to the largest", fmt::join(names, ", ")));
}

/// The least error of a method's finished points, as a line. An answer that stops short of the exact step may
/// lie nearer to the truth: the line is no bound.
void add_line(const CsvTable& table, const std::string& x, const char* method, const char* name,
              pictures::Chart& chart) {
  double least = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (const auto error = table.number(r, x);
        error && *error > 0 && table.text(r, heading_of(&Point::method)) == method)
      least = least == 0 ? *error : std::min(least, *error);
  if (least > 0) chart.lines.push_back({least, name});
}

/// An error at a time has a floor at this time, in a column of its own: the largest of all points.
void add_floor(const CsvTable& table, const std::string& x, const std::string& floor, const char* name,
               pictures::Chart& chart) {
  const std::size_t at = x.find('@');
  if (at == std::string::npos) return;
  double most = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    most = std::max(most, table.number(r, floor + x.substr(at)).value_or(0));
  if (most > 0) chart.lines.push_back({most, name});
}

void add_lines(const CsvTable& table, const std::string& x, pictures::Chart& chart) {
  if (x.rfind(heading_of(&PointRow::truth_at), 0) == 0)
    add_floor(table, x, heading_of(&PointRow::floor_at), "truth floor", chart);
  if (has_role(x, Role::error))
    add_floor(table, x, heading_of(&PointRow::sensitivity_at), "sensitivity to the start's last place",
              chart);
  add_line(table, x, "backward_euler", "step solved exactly", chart);
}

CsvTable table_of(const std::string& results) {
  try {
    CsvTable table =
        files::parse_csv(input::read_whole_file(results, "the results of a sweep", most_bytes), results);
    if (table.rows.empty()) throw input::input_error(results, 1, "", "no row", "the results of a sweep");
    return table;
  } catch (const input::InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw input::InputError(error.what());
  }
}

// The folder has the study beside the results; where it has not, the folder's own name must do.
std::string study_name(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  try {
    const std::string file = (folder / "study.toml").string();
    return study_of(input::read_whole_file(file, "a study file", most_bytes), name + ".toml").name;
  } catch (const std::runtime_error&) {
    return name;
  }
}

pictures::Chart chart_of(const Choice& c, const std::vector<PointGroup>& groups, const std::string& name) {
  pictures::Chart chart;
  chart.guides = has_role(c.y, Role::work) && has_role(c.x, Role::error); // bits, or widths, have no order
  chart.title = name + ": " + (chart.guides ? "speed against accuracy" : c.y + " against " + c.x);
  chart.x_label = axis_label(c.x), chart.y_label = axis_label(c.y);
  if (!c.axes.kept.empty()) chart.labels = c.table.header[c.axes.kept.back()];
  add_series(c, groups, chart);
  add_notes(c, groups, chart);
  add_lines(c.table, c.x, chart);
  return chart;
}

} // namespace

std::string draw_chart(const ChartOrder& order) {
  const CsvTable table = table_of((order.folder / "results.csv").string());
  const std::string x = order.x.empty() ? default_x(table) : order.x;
  const std::string y = order.y.empty() ? default_y(table) : order.y;
  expect_column(table, "--x", x), expect_column(table, "--y", y);
  const AxisColumns axes = axis_columns(table, order.over);
  const std::vector<PointGroup> groups = groups_of(table, axes, x, y);
  const pictures::Chart chart = chart_of({table, x, y, axes}, groups, study_name(order.folder));
  const fs::path out = order.out.empty() ? order.folder : order.out;
  files::check_writable(out, 0);
  const std::string svg = pictures::svg_of(chart);
  files::write_file(out / "chart.svg", svg);
  files::write_file(out / "report.html", pictures::chart_page(chart.title, svg, table));
  std::string text = fmt::format("{} points: {} against {}\n", table.rows.size(), y, x);
  for (const std::string& note : chart.notes) text += note + '\n';
  text += fmt::format("Results\n  {}\n  {}\n", (out / "chart.svg").string(), (out / "report.html").string());
  if (order.over.empty()) return text;
  write_spread(out / "spread.csv", table, axes, groups, x, y);
  return text + fmt::format("  {}\n", (out / "spread.csv").string());
}

} // namespace hopmesh::study
