// A log-log chart of work against error: ladders of each method, the Pareto front, guides, and what failed.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::pictures {

/// From the least to the largest of what a mark stands for.
struct ChartBar {
  double least = 0, largest = 0;
};

struct ChartPoint {
  double x = 0, y = 0;
  bool failed = false; ///< x says nothing: drawn hollow at the right edge
  std::string tip, command;
  std::string label = {};        ///< beside the mark, where there is room
  ChartBar across = {}, up = {}; ///< along x and y; a bar of no length is not drawn
};

/// A method (or one place on an axis): a colour. Each ladder is joined by a line.
struct ChartSeries {
  std::string name;
  std::vector<std::vector<ChartPoint>> ladders;
  bool squares = false; ///< marks of another kind than the others': `keys` of the chart says which
};

/// A vertical line at an error, e.g. where the truth itself is no better known.
struct ChartLine {
  double x = 0;
  std::string name;
};

struct Chart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;
  std::vector<ChartLine> lines;
  bool guides = true;                  ///< slopes: work ~ error^(-1/p) for orders p = 1, 2, 4
  std::string labels = {};             ///< what the labels of marks are, for the legend
  std::vector<std::string> keys = {};  ///< lines of the legend below the names: what its marks mean
  std::vector<std::string> notes = {}; ///< below the chart
  bool curves = false; ///< each ladder is one course: lines that dashes tell apart too, a mark at the end
                       ///< only, neither front nor guides; the first is drawn heavier
};

/// Points that no other beats in both x and y, by rising x.
std::vector<ChartPoint> pareto_front(const std::vector<ChartPoint>& points);

/// Points with an x or y that is not above 0 have no place on a log-log chart and are counted below it.
/// Series without a mark have no place in the legend.
std::string svg_of(const Chart& chart);

} // namespace hopmesh::pictures
