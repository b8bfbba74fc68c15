#include "sim/machine/cost/cost_points.h"

#include "sim/machine/rtl/rtl_sources.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace hopmesh::machine {

namespace {

using Cells = std::vector<std::string>;

Cells cells_of(const std::string& line) {
  Cells cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

bool is_parameter(const std::string& heading) {
  return heading.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
}

CostPoint point_of(const Cells& headings, const Cells& cells) {
  if (cells.size() != headings.size())
    throw std::runtime_error(fmt::format("a point of {} cells, expected {}", cells.size(), headings.size()));
  std::map<std::string, std::string> row;
  for (std::size_t k = 0; k < cells.size(); ++k) row[headings[k]] = cells[k];
  CostPoint point;
  point.array = row.at("array");
  point.fitted = row.at("use") == "fit";
  for (const auto& [heading, cell] : row)
    if (is_parameter(heading)) point.parameters[heading] = std::stoll(cell);
  for (std::size_t p = 0; p < part_names.size(); ++p)
    for (std::size_t f = 0; f < all_figures.size(); ++f) {
      const std::string& cell = row.at(point_heading(Part(p), Figure(f)));
      point.parts[p][f] = cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell);
    }
  return point;
}

} // namespace

std::string point_heading(Part part, Figure figure) {
  return fmt::format("{}_{}", part_names[static_cast<std::size_t>(part)],
                     all_figures[static_cast<std::size_t>(figure)].name);
}

std::vector<CostPoint> read_points(const std::string& text) {
  std::vector<CostPoint> points;
  std::istringstream lines(text);
  Cells headings;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (headings.empty())
      headings = cells_of(line);
    else
      points.push_back(point_of(headings, cells_of(line)));
  }
  return points;
}

const std::vector<CostPoint>& shipped_points() {
  static const std::vector<CostPoint> points = read_points(rtl_source("points.csv"));
  return points;
}

std::string points_text(const std::vector<CostPoint>& points) {
  std::string text = "array,use";
  if (points.empty()) return text + "\n";
  for (const auto& [name, value] : points.front().parameters) text += "," + name;
  for (std::size_t p = 0; p < part_names.size(); ++p)
    for (std::size_t f = 0; f < all_figures.size(); ++f) text += "," + point_heading(Part(p), Figure(f));
  text += '\n';
  for (const CostPoint& point : points) {
    text += point.array + (point.fitted ? ",fit" : ",held");
    for (const auto& [name, value] : point.parameters) text += fmt::format(",{}", value);
    for (const PartFigures& part : point.parts)
      for (const double figure : part) text += std::isnan(figure) ? "," : fmt::format(",{:.6g}", figure);
    text += '\n';
  }
  return text;
}

double whole_figure(const CostPoint& point, Figure figure) {
  double sum = 0;
  for (std::size_t p = 0; p < part_names.size(); ++p) {
    const double part = figure_of(point.parts[p], figure);
    if (figure == Figure::path_ns)
      sum = std::isnan(part) ? part : std::max(sum, part);
    else
      sum += count_of(Part(p), point.parameters) * part;
  }
  return sum;
}

} // namespace hopmesh::machine
