// Sizes of files, sources that no build knows, paths and addresses that belong to one machine.
#include "tests/house/tree.h"

#include "place.h"

#include <gtest/gtest.h>
#include <regex>

namespace hopmesh::tests {
namespace {

TEST(Tree, filesCanBeReadInOneSitting) {
  for (const TreeFile& file : tree_files({".h"}))
    EXPECT_LE(lines_of(file.text).size(), 150u) << file.path << " does more than one thing?";
  for (const TreeFile& file : tree_files({".c", ".cpp", ".sv", ".js"}))
    EXPECT_LE(lines_of(file.text).size(), 300u) << file.path << " does more than one thing?";
}

// Projects of their own; benchmarks, which a build may leave out; the face of a Verilated model, compiled
// with each.
bool built_elsewhere(const std::string& path) {
  return starts_with(path, "tests/example/") || starts_with(path, "tests/bench/") ||
         path == "rtl_model/verilog/hm_model.cpp";
}

/// Lines that name the sources of this build: those compiled alone, and those that a joint source includes.
std::string compiled_sources() {
  std::string compiled;
  for (const std::string& line : lines_of(content_of(HOPMESH_BINARY_DIR "/compile_commands.json"))) {
    if (line.find("\"file\":") == std::string::npos) continue;
    compiled += line + "\n";
    const std::size_t begin = line.find(": \"") + 3, end = line.rfind('"');
    if (line.find("/Unity/unity_") != std::string::npos)
      compiled += content_of(line.substr(begin, end - begin));
  }
  return compiled;
}

TEST(Tree, everySourceIsBuilt) {
  const std::string compiled = compiled_sources();
  for (const TreeFile& file : tree_files({".c", ".cpp"}))
    EXPECT_TRUE(built_elsewhere(file.path) || compiled.find("/" + file.path + "\"") != std::string::npos)
        << file.path << " stands in no CMakeLists.txt";
}

TEST(Tree, nothingBelongsToOneMachine) {
  const std::regex path("(^|[^\\w.])/(work|home)/"), host("https?://(deb|security|registry|proxy|files)\\.");
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp", ".md", ".txt", ".toml", ".json", ".cmake",
                                          ".in", ".js", ".css", ".html", ""})) {
    std::size_t number = 0;
    for (const std::string& line : lines_of(file.text)) {
      ++number;
      EXPECT_FALSE(std::regex_search(line.substr(0, 500), path)) << file.path << ":" << number;
      EXPECT_FALSE(std::regex_search(line.substr(0, 500), host)) << file.path << ":" << number;
    }
  }
}

} // namespace
} // namespace hopmesh::tests
