// results.csv as a picture of speed against accuracy.
#pragma once

#include <filesystem>
#include <string>

namespace hopmesh::study {

struct ChartDrawn {
  std::size_t points;
  std::string x, y; ///< columns
};
/// chart.svg and report.html beside the results in the folder. Columns that are left empty are chosen: the
/// last error that says anything, and the work for it. Throws input::InputError.
ChartDrawn draw_chart(const std::filesystem::path& folder, std::string x, std::string y);

} // namespace hopmesh::study
