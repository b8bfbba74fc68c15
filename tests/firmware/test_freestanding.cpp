// The firmware asks nothing of its platform but sqrt and the memory functions that every compiler may call;
// it has no heap and no state of its own.
#include "place.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <sstream>
#include <string>

namespace {

/// Lines of `nm ARGUMENTS` on the firmware's archive, as (type, symbol).
std::set<std::pair<std::string, std::string>> symbols(const std::string& arguments) {
  std::set<std::pair<std::string, std::string>> found;
  FILE* pipe = popen(("nm -P " + arguments + " " HOPMESH_FIRMWARE_LIBRARY).c_str(), "r");
  if (pipe == nullptr) return found;
  char line[1024];
  while (std::fgets(line, sizeof line, pipe)) {
    std::istringstream words(line);
    std::string symbol, type;
    if (words >> symbol >> type && type.size() == 1) found.insert({type, symbol});
  }
  pclose(pipe);
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
  for (const auto& [type, symbol] : symbols("--defined-only")) defined.insert(symbol);
  ASSERT_TRUE(defined.count("hm_step")) << "nm did not read " HOPMESH_FIRMWARE_LIBRARY;
  for (const auto& [type, symbol] : symbols("--undefined-only"))
    EXPECT_TRUE(allowed.count(symbol) || defined.count(symbol) || of_the_compiler(symbol)) << symbol;
}

TEST(Freestanding, HasNoStateOfItsOwn) {
  for (const auto& [type, symbol] : symbols("--defined-only"))
    EXPECT_TRUE(std::string("bBdDC").find(type) == std::string::npos || of_the_compiler(symbol))
        << type << " " << symbol;
}

} // namespace
