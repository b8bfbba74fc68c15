#include "sim/study/stability_map.h"

#include "sim/files/csv.h"
#include "sim/input/number.h"
#include "sim/pictures/chart_page.h"
#include "sim/pictures/svg_map.h"
#include "sim/study/result_table.h"
#include "sim/study/study_points.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;
using files::CsvTable;

// In the order of Stability.
constexpr const char* colours[stability_count] = {"#8fd19e", "#c0392b", "#e67e22", "#8e44ad",
                                                  "#f4d35e", "#34495e", "#7fb3d5", "#c9b79c"};

/// What the explicit limits and a relaxation's cost predict, as a largest time step.
constexpr double verlet_limit = 2, runge_kutta_limit = 2.83, sweeps_a_step = 0.4;

std::optional<double> number_of(const std::string& text) {
  double value = 0;
  return input::parse_number(text, value) ? std::optional(value) : std::nullopt;
}

bool is_numeric(const StudyAxis& axis) {
  return axis.places.size() > 1 && std::all_of(axis.places.begin(), axis.places.end(),
                                               [](const auto& place) { return number_of(place.label); });
}

/// Numbers of the axes that span the map: the first two numeric ones.
std::pair<std::size_t, std::size_t> map_axes(const Study& study) {
  std::vector<std::size_t> numeric;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (is_numeric(study.axes[a])) numeric.push_back(a);
  if (numeric.size() < 2)
    throw input::input_error(study.path, study.axes.empty() ? 0 : study.axes.back().line, "axes",
                             fmt::format("{} axes of numbers", numeric.size()),
                             "two axes of at least two numbers each");
  return {numeric[0], numeric[1]};
}

std::vector<double> rising_places(const StudyAxis& axis) {
  std::vector<double> values;
  for (const auto& place : axis.places) values.push_back(*number_of(place.label));
  std::sort(values.begin(), values.end());
  if (std::adjacent_find(values.begin(), values.end()) != values.end())
    throw input::InputError(fmt::format("axis {}: a number twice", axis.name));
  return values;
}

std::size_t index_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

class MapOfStudy {
 public:
  MapOfStudy(const Study& study, const CsvTable& table) : study_(study), table_(table) {
    std::tie(x_, y_) = map_axes(study);
    map_.title = study.name + ": what becomes of the motion";
    map_.x_label = study.axes[x_].name, map_.y_label = study.axes[y_].name;
    map_.xs = rising_places(study.axes[x_]), map_.ys = rising_places(study.axes[y_]);
    for (std::size_t k = 0; k < stability_count; ++k) map_.kinds.push_back({stability_names[k], colours[k]});
  }

  pictures::CellMap drawn() {
    for (std::size_t r = 0; r < table_.rows.size(); ++r) add_cell(r);
    return map_;
  }

 private:
  /// The method and what else varies, but for the two axes.
  std::string panel_title(std::size_t row) const {
    std::string title = table_.text(row, heading_of(&Point::method));
    for (std::size_t a = 0; a < study_.axes.size(); ++a)
      if (a != x_ && a != y_) title += ", " + table_.rows[row][1 + a];
    return title;
  }

  pictures::MapPanel& panel_of(std::size_t row) {
    const std::string title = panel_title(row);
    for (pictures::MapPanel& panel : map_.panels)
      if (panel.title == title) return panel;
    const std::vector<std::vector<pictures::MapCell>> empty(map_.ys.size(),
                                                            std::vector<pictures::MapCell>(map_.xs.size()));
    map_.panels.push_back(
        {title, empty, {{"dt omega = 2", {}}, {"dt omega = 2.83", {}}, {"sweeps = 0.4 (dt omega)^2", {}}}});
    return map_.panels.back();
  }

  /// A cell of results.csv, in which a user may have written anything.
  input::InputError error(std::size_t row, const std::string& key, const std::string& found) const {
    return input::input_error("results.csv", static_cast<int>(row) + 2, key, input::in_quotes(found),
                              "what the study can come to");
  }

  double place_of(std::size_t row, std::size_t axis, const std::vector<double>& places) const {
    const std::string& text = table_.rows[row][1 + axis];
    const auto value = number_of(text);
    if (!value || !std::binary_search(places.begin(), places.end(), *value))
      throw error(row, study_.axes[axis].name, text);
    return *value;
  }

  std::size_t kind_of(std::size_t row) const {
    const std::string& name = table_.text(row, heading_of(&PointRow::stability));
    const auto found = std::find(std::begin(stability_names), std::end(stability_names), name);
    if (found == std::end(stability_names)) throw error(row, heading_of(&PointRow::stability), name);
    return static_cast<std::size_t>(found - std::begin(stability_names));
  }

  void add_cell(std::size_t row) {
    pictures::MapPanel& panel = panel_of(row);
    const double x = place_of(row, x_, map_.xs), y = place_of(row, y_, map_.ys);
    pictures::MapCell& cell = panel.cells[index_of(map_.ys, y)][index_of(map_.xs, x)];
    const std::string& name = table_.text(row, heading_of(&PointRow::stability));
    cell.kind = kind_of(row);
    cell.tip = fmt::format("{} = {}, {} = {}\n{}: {}", map_.x_label, x, map_.y_label, y, name,
                           table_.text(row, heading_of(&PointRow::sentence)));
    cell.command = table_.text(row, heading_of(&Point::command));
    if (map_.x_label == "motion.time_step" && index_of(map_.xs, x) == 0) predict(row, y, panel);
  }

  /// The largest time steps at this y; omega and the budget of sweeps may depend on it.
  void predict(std::size_t row, double y, pictures::MapPanel& panel) {
    const double omega = table_.number(row, heading_of(&PointRow::omega)).value_or(0);
    if (omega <= 0) return;
    const auto inputs = inputs_of(study_, point_of(study_, row));
    const auto budget = static_cast<double>(inputs.scene.relax.max_sweeps);
    const double steps[] = {verlet_limit / omega, runge_kutta_limit / omega,
                            std::sqrt(budget / sweeps_a_step) / omega};
    for (std::size_t k = 0; k < 3; ++k) {
      auto& points = panel.lines[k].points;
      const auto after = std::lower_bound(points.begin(), points.end(), y,
                                          [](const auto& p, double value) { return p.second < value; });
      points.insert(after, {steps[k], y});
    }
  }

  const Study& study_;
  const CsvTable& table_;
  std::size_t x_ = 0, y_ = 0;
  pictures::CellMap map_;
};

void write_classes(const Study& study, const CsvTable& table, const fs::path& path) {
  std::vector<std::string> columns{heading_of(&Point::number)};
  for (const auto& axis : study.axes) columns.push_back(axis.name);
  for (const char* name :
       {heading_of(&Point::method), heading_of(&PointRow::stability), heading_of(&PointRow::outcome),
        heading_of(&PointRow::steps), heading_of(&PointRow::largest_strain), heading_of(&PointRow::omega),
        heading_of(&Point::command)})
    columns.emplace_back(name);
  files::CsvWriter out(path, columns);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (const std::string& name : columns) out.cell(table.text(r, name));
    out.end_row();
  }
  out.commit();
}

} // namespace

void check_map(const Study& study) {
  map_axes(study);
}

bool draw_map(const fs::path& folder, const Study& study) {
  if (!fs::exists(folder / "results.csv")) return false;
  const CsvTable table = files::read_csv(folder / "results.csv");
  const std::string svg = pictures::svg_of(MapOfStudy(study, table).drawn());
  write_classes(study, table, folder / "stability.csv");
  files::write_file(folder / "stability.svg", svg);
  files::write_file(folder / "report.html", pictures::chart_page(study.name, svg, table));
  return true;
}

} // namespace hopmesh::study
