// The firmware asks nothing of its platform but sqrt and the memory functions that every compiler may call;
// it has no heap and no state of its own.
#include "tests/support/files.h"
#include "tests/support/program.h"

#include "place.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace hopmesh::tests {
namespace {

struct Symbol {
  std::string name, type, section;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \n") - first + 1);
}

/// Lines of `nm OPTION` on the firmware's archive: name, value, type, class, size, line, section.
std::vector<Symbol> symbols(const std::string& option) {
  std::vector<Symbol> found;
  for (const std::string& line :
       lines_of(run_shell("nm -f sysv " + option + " " HOPMESH_FIRMWARE_LIBRARY).out)) {
    std::vector<std::string> columns;
    std::istringstream text(line);
    for (std::string column; std::getline(text, column, '|');) columns.push_back(trimmed(column));
    if (columns.size() == 7) found.push_back({columns[0], columns[2], columns[6]});
  }
  return found;
}

bool of_the_compiler(const std::string& symbol) {
  for (const char* prefix :
       {"__asan", "__ubsan", "__stack_chk", "__gcov", "__llvm", "_GLOBAL_OFFSET_TABLE_", "__odr", ".L"})
    if (symbol.rfind(prefix, 0) == 0) return true;
  return false;
}

TEST(Freestanding, NeedsNothingButSqrtAndMemoryFunctions) {
  const std::set<std::string> allowed{"sqrt", "memcpy", "memset", "memmove", "memcmp"};
  std::set<std::string> defined;
  for (const Symbol& symbol : symbols("--defined-only")) defined.insert(symbol.name);
  ASSERT_TRUE(defined.count("hm_step")) << "nm did not read " HOPMESH_FIRMWARE_LIBRARY;
  for (const auto& [name, type, section] : symbols("--undefined-only"))
    EXPECT_TRUE(allowed.count(name) || defined.count(name) || of_the_compiler(name)) << name;
}

/// Constants that hold addresses may lie where a loader writes those; nobody writes there afterwards.
TEST(Freestanding, HasNoStateOfItsOwn) {
  for (const auto& [name, type, section] : symbols("--defined-only"))
    EXPECT_TRUE(std::string("bBdDC").find(type) == std::string::npos ||
                section.rfind(".data.rel.ro", 0) == 0 || of_the_compiler(name))
        << type << " " << name << " in " << section;
}

} // namespace
} // namespace hopmesh::tests
