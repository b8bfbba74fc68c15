// Arrays whose parts were measured: what the cost model is fitted to, and what it is held to. The file
// points.csv beside this one is made by tests/campaigns/cost_points.
#pragma once

#include "sim/machine/cost/part_features.h"

#include <array>

namespace hopmesh::machine {

struct CostPoint {
  std::string array;
  bool fitted = false; ///< the model may learn from it; else it is judged by it
  Parameters parameters;
  std::array<PartFigures, 3> parts; ///< by Part
};

/// Reads such a table. Throws std::runtime_error for a row that is none.
std::vector<CostPoint> read_points(const std::string& text);
/// Those that the program comes with.
const std::vector<CostPoint>& shipped_points();

/// The heading of a figure of a part.
std::string point_heading(Part part, Figure figure);
/// A table of these points, as read_points takes it.
std::string points_text(const std::vector<CostPoint>& points);

/// A figure of the whole: all elements, all stages and the rest. NaN where a part's is not known.
double whole_figure(const CostPoint& point, Figure figure);

} // namespace hopmesh::machine
