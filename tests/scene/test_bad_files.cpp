// Folders of bad files, by what is wrong with them: each is refused in one line that names the place and the
// mistake, at once.
#include "sim/input/array_file.h"
#include "tests/scene/scene_makers.h"

#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <map>
#include <set>

namespace hopmesh::tests {
namespace {

using namespace scene;

const std::string bad = folder + "bad/";

struct Case {
  std::string file, line, message;
};

/// The rows "file | line | message" of expected.txt.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& row : lines_of(content_of(bad + "expected.txt"))) {
    const auto first = row.find(" | "), second = row.find(" | ", first + 1);
    if (row.empty() || row[0] == '#') continue;
    all.push_back({row.substr(0, first), row.substr(first + 3, second - first - 3), row.substr(second + 3)});
  }
  return all;
}

std::string good_scene() {
  return folder + "good/every_key.toml";
}

void read(const std::string& file) {
  if (file.rfind("array/", 0) == 0)
    read_inputs(good_scene(), bad + file, {});
  else if (std::filesystem::path(file).extension() == ".obj")
    build_mesh(file_scene(bad + file));
  else
    build_mesh(read_inputs(bad + file, "", {}).scene);
}

std::string complaint_about(const Case& c) {
  return complaint([&] { read(c.file); });
}

TEST(BadFiles, areManyAndAllListed) {
  std::set<std::string> listed, there;
  for (const Case& c : cases()) EXPECT_TRUE(listed.insert(c.file).second) << c.file << " is listed twice";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(bad))
    if (entry.is_regular_file()) there.insert(entry.path().lexically_relative(bad).string());
  for (const char* other : {"expected.txt", ".gitattributes", "file/tiny_edge.obj"}) there.erase(other);
  EXPECT_EQ(listed, there);
}

TEST(BadFiles, areRefusedWithPlaceAndReason) {
  for (const Case& c : cases()) {
    const std::string message = complaint_about(c);
    EXPECT_THAT(message, ::testing::HasSubstr(c.message)) << c.file;
    if (c.line == "-")
      EXPECT_EQ(message.find(c.file + ":1"), std::string::npos) << message;
    else
      EXPECT_THAT(message, ::testing::HasSubstr(c.file + ":" + c.line + ": "));
  }
}

TEST(BadFiles, nameTheFileInOneShortLine) {
  for (const Case& c : cases()) {
    const std::string message = complaint_about(c);
    EXPECT_EQ(message.find_first_of("\n\r\t\x1b"), std::string::npos) << message;
    EXPECT_LT(message.size(), bad.size() + 500) << message;
    EXPECT_THAT(message, ::testing::HasSubstr("tests/scene/bad")) << message;
  }
}

TEST(BadFiles, areEachBadInTheirOwnWay) {
  std::map<std::string, std::string> seen;
  for (const Case& c : cases()) {
    std::string message = complaint_about(c);
    const auto name = message.find(c.file);
    if (name != std::string::npos)
      message.erase(name, c.file.size()); // what is left tells the mistakes apart
    const auto [other, fresh] = seen.emplace(message, c.file);
    EXPECT_TRUE(fresh) << c.file << " says what " << other->second << " says: " << message;
  }
}

double seconds_for(const Case& c) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  complaint_about(c);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The best of three: a busy machine may interrupt one of them.
TEST(BadFiles, areRefusedAtOnce) {
  for (const Case& c : cases())
    EXPECT_LT(std::min({seconds_for(c), seconds_for(c), seconds_for(c)}), 0.1) << c.file;
}

TEST(BadPaths, areRefused) {
  const auto read_scene = [](const std::string& path) {
    return complaint([&] { read_inputs(path, "", {}); });
  };
  const auto read_array = [](const std::string& path) {
    return complaint([&] { read_inputs(good_scene(), path, {}); });
  };
  EXPECT_EQ(read_scene("/no/such.toml"), "/no/such.toml: found no such file, expected a scene file");
  EXPECT_EQ(read_array("/no/such.toml"), "/no/such.toml: found no such file, expected an array file");
  EXPECT_EQ(read_scene(folder), folder + ": found a directory, expected a scene file");
  EXPECT_EQ(read_array(folder), folder + ": found a directory, expected an array file");
  EXPECT_EQ(read_scene("/dev/zero"),
            "/dev/zero: found more than 1048576 bytes, expected a scene file of at most that size");
  EXPECT_THAT(read_scene(""),
              ::testing::StartsWith("scene: found \"\", expected a scene file, or one of banner, "));
}

TEST(BadNames, getTheNearestShippedOne) {
  EXPECT_THAT(complaint([] { read_inputs("flag400", "", {}); }),
              ::testing::EndsWith("(did you mean flag-400?)"));
  EXPECT_EQ(complaint([] { read_inputs("flag-400", "descend", {}); }),
            "array: found \"descend\", expected an array file, or \"guarded\", \"descent\", \"prescaled\", "
            "\"byte\", \"folded\", \"descent-projected\" or \"descent-momentum\" "
            "(did you mean descent?)");
}

} // namespace
} // namespace hopmesh::tests
