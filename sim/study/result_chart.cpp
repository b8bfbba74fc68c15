#include "sim/study/result_chart.h"

#include "sim/files/output_file.h"
#include "sim/input/whole_file.h"
#include "sim/pictures/chart_page.h"
#include "sim/pictures/svg_chart.h"
#include "sim/study/result_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;
using files::CsvTable;

constexpr std::size_t most_bytes = std::size_t{1} << 30;

std::size_t known_column(const CsvTable& table, const std::string& flag, const std::string& name) {
  const auto found = table.column(name);
  if (!found)
    throw input::input_error("", 0, flag, name, "a column of results.csv",
                             input::nearest_name(name, table.header));
  return *found;
}

bool has_role(const std::string& heading, Role role) {
  const ResultColumn* column = column_headed(heading);
  return column && column->role == role;
}

bool has_numbers(const CsvTable& table, const std::string& name) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.number(r, name).value_or(0) > 0) return true;
  return false;
}

bool is_finished(const CsvTable& table, std::size_t row) {
  return table.text(row, heading_of(&PointRow::outcome)) == run::name_of(run::Outcome::finished);
}

// Time of the array where every method that got to the end has one, else of this machine.
std::string default_y(const CsvTable& table) {
  std::string array = heading_of(&PointRow::array_seconds), host = heading_of(&PointRow::host_seconds);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (is_finished(table, r) && table.number(r, array).value_or(0) == 0) return host;
  return has_numbers(table, array) ? array : host;
}

// The last error that says anything is worth most.
std::string default_x(const CsvTable& table) {
  for (std::size_t k = table.header.size(); k-- > 0;) {
    const std::string& heading = table.header[k];
    if (has_role(heading, Role::error) && has_numbers(table, heading)) return heading;
  }
  return heading_of(&PointRow::position_error);
}

std::string tip_of(const CsvTable& table, std::size_t row, std::size_t method, const std::string& x,
                   const std::string& y) {
  std::string tip = fmt::format("point {}, {}", table.text(row, heading_of(&Point::number)),
                                table.text(row, heading_of(&Point::method)));
  for (std::size_t k = 1; k < method; ++k)
    tip += fmt::format("\n{} = {}", table.header[k], table.rows[row][k]);
  return tip + fmt::format("\n{}: {}\n{}: {}\n{}, {}", x, table.text(row, x), y, table.text(row, y),
                           table.text(row, heading_of(&PointRow::outcome)),
                           table.text(row, heading_of(&PointRow::stability)));
}

/// What the points of one ladder share: all but the last axis.
std::vector<std::string> ladder_of(const CsvTable& table, std::size_t row, std::size_t method) {
  const auto& cells = table.rows[row];
  std::vector<std::string> shared{cells[method]};
  for (std::size_t k = 1; k + 1 < method; ++k) shared.push_back(cells[k]);
  return shared;
}

pictures::ChartSeries& series_named(pictures::Chart& chart, const std::string& name) {
  for (pictures::ChartSeries& s : chart.series)
    if (s.name == name) return s;
  return chart.series.emplace_back(pictures::ChartSeries{name, {}});
}

// A colour a method; where there is one only, a colour for each place of the first axis.
std::vector<pictures::ChartSeries> series_of(const CsvTable& table, const std::string& x,
                                             const std::string& y) {
  pictures::Chart chart;
  const std::size_t method = known_column(table, "results.csv", heading_of(&Point::method));
  const bool one = std::all_of(table.rows.begin(), table.rows.end(),
                               [&](const auto& r) { return r[method] == table.rows[0][method]; });
  std::map<std::vector<std::string>, std::size_t> ladders;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string name =
        one && method > 2 ? fmt::format("{} {}", table.header[1], table.rows[r][1]) : table.rows[r][method];
    pictures::ChartSeries& series = series_named(chart, name);
    const auto [place, fresh] = ladders.try_emplace(ladder_of(table, r, method), series.ladders.size());
    if (fresh) series.ladders.emplace_back();
    pictures::ChartPoint p;
    p.failed = !is_finished(table, r);
    p.x = table.number(r, x).value_or(0), p.y = table.number(r, y).value_or(0);
    p.tip = tip_of(table, r, method, x, y), p.command = table.text(r, heading_of(&Point::command));
    series.ladders[place->second].push_back(std::move(p));
  }
  return chart.series;
}

/// The least error of a method's finished points, as a line: nobody with the same step can do better.
void add_line(const CsvTable& table, const std::string& x, const char* method, const char* name,
              pictures::Chart& chart) {
  double least = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (const auto error = table.number(r, x);
        error && *error > 0 && table.text(r, heading_of(&Point::method)) == method)
      least = least == 0 ? *error : std::min(least, *error);
  if (least > 0) chart.lines.push_back({least, name});
}

/// How far the truth itself is known.
void add_floor(const CsvTable& table, const std::string& x, pictures::Chart& chart) {
  const std::string error = heading_of(&PointRow::truth_at), floor = heading_of(&PointRow::floor_at);
  if (x.rfind(error, 0) != 0) return;
  double most = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    most = std::max(most, table.number(r, floor + x.substr(error.size())).value_or(0));
  if (most > 0) chart.lines.push_back({most, "truth floor"});
}

std::string axis_label(const std::string& heading) {
  const ResultColumn* column = column_headed(heading);
  if (!column || !*column->unit) return heading;
  return fmt::format("{}{}, {}", heading, column->role == Role::error ? " (rms)" : "", column->unit);
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

pictures::Chart chart_of(const CsvTable& table, const std::string& x, const std::string& y,
                         const std::string& name) {
  pictures::Chart chart;
  chart.guides = has_role(y, Role::work) && has_role(x, Role::error); // bits, or widths, have no order
  chart.title = name + ": " + (chart.guides ? "speed against accuracy" : y + " against " + x);
  chart.x_label = axis_label(x), chart.y_label = axis_label(y);
  chart.series = series_of(table, x, y);
  add_floor(table, x, chart);
  add_line(table, x, "backward_euler", "step solved exactly", chart);
  return chart;
}

} // namespace

ChartDrawn draw_chart(const fs::path& folder, std::string x, std::string y) {
  const CsvTable table = table_of((folder / "results.csv").string());
  if (x.empty()) x = default_x(table);
  if (y.empty()) y = default_y(table);
  known_column(table, "--x", x), known_column(table, "--y", y);
  const pictures::Chart chart =
      chart_of(table, x, y, fs::absolute(folder).lexically_normal().filename().string());
  const std::string svg = pictures::svg_of(chart);
  files::write_file(folder / "chart.svg", svg);
  files::write_file(folder / "report.html", pictures::chart_page(chart.title, svg, table));
  return {table.rows.size(), x, y};
}

} // namespace hopmesh::study
