// Tables of pages that are printed from tables of the program: registers, keys, presets, columns of results.
#pragma once

#include "sim/input/key_table.h"
#include "sim/levels/step_columns.h"
#include "sim/study/point_row.h"

#include <string>
#include <vector>

namespace hopmesh::tests {

inline constexpr const char* registers_page = "docs/hardware/registers.md";
inline constexpr const char* results_page = "docs/use/results-folder.md";
inline constexpr const char* scene_page = "docs/use/scene-files.md";
inline constexpr const char* array_page = "docs/use/array-files.md";
inline constexpr const char* studies_page = "docs/use/study-files.md";

/// Columns as a page shows them.
std::string step_table(const std::vector<levels::StepColumn>& columns);
std::string result_table(const std::vector<study::ResultColumn>& columns);

/// Rows of keys as a page shows them.
std::string key_table(const input::Keys& keys);
std::string scene_table();
std::string array_table();
/// The keys in which presets differ.
std::string preset_table();

/// A line of a table.
std::string page_row(const std::vector<std::string>& cells);

/// The page with what stands between its <!-- table NAME --> and <!-- end --> lines printed afresh.
std::string with_tables(const std::string& page);

} // namespace hopmesh::tests
