// results.csv as a picture of speed against accuracy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hopmesh::study {

struct ChartOrder {
  std::filesystem::path folder;  ///< of the results
  std::filesystem::path out;     ///< of the picture; empty: the same
  std::string x, y;              ///< columns; empty: the last error that says anything, and the work for it
  std::vector<std::string> over; ///< axes along which points are one mark
};

/// chart.svg and report.html, and spread.csv where points are one mark. Returns what was drawn in lines for
/// people. Throws input::InputError.
std::string draw_chart(const ChartOrder& order);

} // namespace hopmesh::study
