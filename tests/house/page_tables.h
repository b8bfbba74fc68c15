// Tables of pages that are printed from tables of the program: registers, keys of files, presets.
#pragma once

#include "sim/input/key_table.h"

#include <string>

namespace hopmesh::tests {

inline constexpr const char* registers_page = "docs/hardware/registers.md";
inline constexpr const char* scene_page = "docs/use/scene-files.md";
inline constexpr const char* array_page = "docs/use/array-files.md";

/// Rows of keys as a page shows them.
std::string key_table(const input::Keys& keys);
std::string scene_table();
std::string array_table();
/// The keys in which presets differ.
std::string preset_table();

/// The page with what stands between its <!-- table NAME --> and <!-- end --> lines printed afresh.
std::string with_tables(const std::string& page);

} // namespace hopmesh::tests
