// Only the room of the levels knows a level by its name: everybody else asks the table what a level can do.
#include "sim/levels/level.h"
#include "tests/house/tree.h"

#include <gtest/gtest.h>
#include <regex>

namespace hopmesh::tests {
namespace {

/// A name of a level as a whole string literal; "" where the line has none. Rivals are no matter: some of
/// them are also rules of a scene (bdf2).
std::string literal_of_level(const std::string& line) {
  for (const std::string& name : levels::level_names(levels::sweeping))
    if (line.find('"' + name + '"') != std::string::npos) return name;
  return "";
}

bool may_name_levels(const std::string& path) {
  const bool is_verb = path == "sim/cli/array/rtl.cpp"; // which bears such a name
  return is_verb || starts_with(path, "sim/levels/") || starts_with(path, "tests/");
}

TEST(Levels, NobodyElseNamesALevel) {
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp"})) {
    if (may_name_levels(file.path)) continue;
    std::size_t number = 0;
    for (const std::string& line : lines_of(file.text))
      EXPECT_EQ(literal_of_level(line), "") << file.path << ":" << ++number;
  }
}

TEST(Levels, ALiteralIsFound) {
  EXPECT_EQ(literal_of_level("  if (level == \"systemc-clock\") return;"), "systemc-clock");
  EXPECT_EQ(literal_of_level("  \"hopmesh run --level systemc\""), "");
}

} // namespace
} // namespace hopmesh::tests
