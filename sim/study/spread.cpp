#include "sim/study/spread.h"

#include "sim/files/csv.h"
#include "sim/study/result_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace hopmesh::study {

namespace {

using files::CsvTable;

std::vector<double> figures(const CsvTable& table, const std::vector<std::size_t>& rows,
                            const std::string& name) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(table.number(row, name).value_or(0));
  return values;
}

void tell(const CsvTable& table, const std::string& x, const std::string& y, PointGroup& group) {
  for (const std::size_t row : group.rows)
    if (is_finished(table, row) && table.number(row, x) && table.number(row, y)) group.told.push_back(row);
  group.middle = group.rows[0];
  if (group.told.empty()) return;
  const std::vector<double> xs = figures(table, group.told, x);
  group.x = spread_of(xs), group.y = spread_of(figures(table, group.told, y));
  const auto away = [&](double value) { return std::fabs(value - group.x.median); };
  const auto nearest =
      std::min_element(xs.begin(), xs.end(), [&](double a, double b) { return away(a) < away(b); });
  group.middle = group.told[static_cast<std::size_t>(nearest - xs.begin())];
}

std::vector<std::string> spread_header(const CsvTable& table, const AxisColumns& axes,
                                       const std::vector<std::string>& figures) {
  std::vector<std::string> header{table.header[axes.method]};
  for (const std::size_t axis : axes.kept) header.push_back(table.header[axis]);
  for (const char* name : {"points", "told"}) header.emplace_back(name);
  for (const std::string& figure : figures)
    for (const char* which : {"_median", "_least", "_largest"}) header.push_back(figure + which);
  return header;
}

} // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[half] : values[half - 1] / 2 + values[half] / 2; // no overflow
  return {values.front(), median, values.back()};
}

AxisColumns axis_columns(const CsvTable& table, const std::vector<std::string>& over) {
  const auto method = table.column(heading_of(&Point::method));
  if (!method || *method == 0) // a point's number and the axes stand before it
    throw input::input_error("results.csv", 1, "", method ? "column method first" : "no column method",
                             "the results of a sweep");
  AxisColumns axes;
  axes.method = *method;
  const std::vector<std::string> names(table.header.begin() + 1,
                                       table.header.begin() + static_cast<std::ptrdiff_t>(*method));
  for (const std::string& name : over)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw input::input_error("", 0, "--over", name,
                               names.empty()
                                   ? "an axis of the study, which has none"
                                   : fmt::format("an axis of the study: {}", fmt::join(names, ", ")),
                               input::nearest_name(name, names));
  for (std::size_t k = 0; k < names.size(); ++k)
    (std::find(over.begin(), over.end(), names[k]) == over.end() ? axes.kept : axes.over).push_back(k + 1);
  return axes;
}

bool is_finished(const CsvTable& table, std::size_t row) {
  return table.text(row, heading_of(&PointRow::outcome)) == run::name_of(run::Outcome::finished);
}

std::vector<PointGroup> groups_of(const CsvTable& table, const AxisColumns& axes, const std::string& x,
                                  const std::string& y) {
  std::vector<PointGroup> groups;
  std::map<std::vector<std::string>, std::size_t> places;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> shared{table.rows[r][axes.method]};
    for (const std::size_t axis : axes.kept) shared.push_back(table.rows[r][axis]);
    if (axes.over.empty()) shared.push_back(std::to_string(r)); // labels may repeat
    const auto [place, fresh] = places.try_emplace(shared, groups.size());
    if (fresh) groups.emplace_back();
    groups[place->second].rows.push_back(r);
  }
  for (PointGroup& group : groups) tell(table, x, y, group);
  return groups;
}

void write_spread(const std::filesystem::path& file, const CsvTable& table, const AxisColumns& axes,
                  const std::vector<PointGroup>& groups, const std::string& x, const std::string& y) {
  files::CsvWriter rows(file, spread_header(table, axes, {x, y}));
  for (const PointGroup& group : groups) {
    const auto& cells = table.rows[group.rows[0]];
    rows.cell(cells[axes.method]);
    for (const std::size_t axis : axes.kept) rows.cell(cells[axis]);
    rows.cell(group.rows.size()).cell(group.told.size());
    for (const Spread& spread : {group.x, group.y})
      for (const double value : {spread.median, spread.least, spread.largest})
        rows.cell(group.told.empty() ? Maybe() : Maybe(value));
    rows.end_row();
  }
  rows.commit();
}

} // namespace hopmesh::study
