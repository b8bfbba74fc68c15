#include "sim/study/chart_columns.h"

#include "sim/input/input_error.h"
#include "sim/levels/level.h"
#include "sim/study/result_table.h"
#include "sim/study/spread.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

using files::CsvTable;

bool has_numbers(const CsvTable& table, const std::string& name) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.number(r, name).value_or(0) > 0) return true;
  return false;
}

bool is_rival(const std::string& method) {
  for (const levels::Level& level : levels::levels())
    if (level.name == method) return level.kind == levels::Kind::rival;
  return false;
}

} // namespace

std::string default_x(const CsvTable& table) {
  for (std::size_t k = table.header.size(); k-- > 0;) {
    const std::string& heading = table.header[k];
    if (has_role(heading, Role::error) && has_numbers(table, heading)) return heading;
  }
  return heading_of(&PointRow::position_error);
}

std::string default_y(const CsvTable& table) {
  const std::string hardware = heading_of(&PointRow::hardware_seconds);
  std::string host = heading_of(&PointRow::host_seconds);
  if (has_rivals(table)) return host;
  return has_numbers(table, hardware) ? hardware : host;
}

bool has_rivals(const CsvTable& table) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (is_finished(table, r) && is_rival(table.text(r, heading_of(&Point::method)))) return true;
  return false;
}

void expect_column(const CsvTable& table, const std::string& flag, const std::string& name) {
  if (!table.column(name))
    throw input::input_error("", 0, flag, name, "a column of results.csv",
                             input::nearest_name(name, table.header));
}

bool has_role(const std::string& heading, Role role) {
  const ResultColumn* column = column_headed(heading);
  return column && column->role == role;
}

std::string axis_label(const std::string& heading) {
  const ResultColumn* column = column_headed(heading);
  if (!column || !*column->unit) return heading;
  return fmt::format("{}{}, {}", heading, column->role == Role::error ? " (rms)" : "", column->unit);
}

} // namespace hopmesh::study
