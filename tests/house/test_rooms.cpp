// Rooms that can be taken in at a glance: few sources in each, and no two headers that are called almost
// alike.
#include "tests/house/tree.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

TEST(Rooms, holdAtMostTwentySources) {
  std::map<std::string, int> sources;
  for (const TreeFile& file : tree_files({".c", ".cpp", ".sv"})) ++sources[fs::path(file.path).parent_path()];
  for (const auto& [room, count] : sources) EXPECT_LE(count, 20) << room << " wants inner rooms";
}

// A verb is flags, a footer and a short callback; what it does is a room's below.
TEST(Rooms, haveShortVerbs) {
  for (const TreeFile& file : tree_files({".h", ".cpp"}))
    if (starts_with(file.path, "sim/cli/")) {
      EXPECT_LT(lines_of(file.text).size(), 150u) << file.path << " wants to be a room's below";
    }
}

/// Whether a letter put in, left out or changed makes one word of the other.
bool a_letter_apart(const std::string& a, const std::string& b) {
  if (a.size() > b.size()) return a_letter_apart(b, a);
  const std::size_t k =
      static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
  if (a.size() == b.size()) return k < a.size() && a.substr(k + 1) == b.substr(k + 1);
  return a.size() + 1 == b.size() && a.substr(k) == b.substr(k + 1);
}

bool almost_alike(const std::string& a, const std::string& b) {
  return a_letter_apart(a, b) || a + "es" == b || b + "es" == a;
}

TEST(Rooms, holdNoTwoHeadersALetterApart) {
  std::map<std::string, std::string> headers; // by stem
  for (const TreeFile& file : tree_files({".h"})) headers[fs::path(file.path).stem()] = file.path;
  for (auto a = headers.begin(); a != headers.end(); ++a)
    for (auto b = std::next(a); b != headers.end(); ++b)
      EXPECT_FALSE(almost_alike(a->first, b->first)) << a->second << " and " << b->second;
}

TEST(Rooms, tellNamesApartThatAreALetterApart) {
  EXPECT_TRUE(almost_alike("method", "methods"));
  EXPECT_TRUE(almost_alike("mesh", "meshes"));
  EXPECT_TRUE(almost_alike("plan", "plank"));
  EXPECT_TRUE(almost_alike("race", "rate"));
  EXPECT_FALSE(almost_alike("race", "rats"));
  EXPECT_FALSE(almost_alike("plan", "planned"));
  EXPECT_FALSE(almost_alike("mesh", "mesh"));
}

} // namespace
} // namespace hopmesh::tests
