// Classes over a grid of two settings, panels side by side, with predicted lines across them.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::pictures {

struct MapCell {
  std::size_t kind = 0; ///< index of StabilityMap::kinds
  std::string tip, command;
};

/// A curve through (x, y) in the axes' own values.
struct MapLine {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

struct MapPanel {
  std::string title;
  std::vector<std::vector<MapCell>> cells; ///< [y][x]
  std::vector<MapLine> lines;
};

struct KindOfCell {
  std::string name, colour;
};

struct CellMap {
  std::string title, x_label, y_label;
  std::vector<double> xs, ys; ///< rising
  std::vector<KindOfCell> kinds;
  std::vector<MapPanel> panels;
};

std::string svg_of(const CellMap& map);

/// Where a value stands among rising ones, in cells: the k-th value is at k + 0.5, logarithmic in between
/// where all are above 0. Beyond the ends by the last interval's measure.
double place_among(const std::vector<double>& values, double value);

} // namespace hopmesh::pictures
