// Pages can be found and trusted: links, anchors and named files exist, each page says whom it is for, the
// index knows them all, and the papers at the front door agree about the version.
#include "place.h"

#include "tests/house/tree.h"

#include "place.h"

#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

struct Link {
  std::string path, anchor; ///< from the root of the tree; either may be empty
};

/// Links of a page that stay inside the tree.
std::vector<Link> links_of(const TreeFile& page) {
  static const std::regex link("\\]\\(([^)#\\s]*)(?:#([^)\\s]*))?\\)");
  std::vector<Link> links;
  for (std::sregex_iterator at(page.text.begin(), page.text.end(), link), end; at != end; ++at) {
    const std::string target = (*at)[1];
    if (target.find("://") != std::string::npos) continue;
    const fs::path path = target.empty() ? fs::path(page.path) : fs::path(page.path).parent_path() / target;
    links.push_back({path.lexically_normal().string(), (*at)[2]});
  }
  return links;
}

/// What a heading is called in an address: small letters, blanks as hyphens, no other punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) || c == '-' || c == '_' || byte > 127)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  for (const std::string& line : lines_of(text))
    if (const auto blank = line.find(' '); line[0] == '#' && blank != std::string::npos)
      anchors.insert(anchor_of(line.substr(blank + 1)));
  return anchors;
}

TEST(Pages, linksLeadSomewhere) {
  for (const TreeFile& page : tree_files({".md"}))
    for (const Link& link : links_of(page)) {
      EXPECT_TRUE(fs::exists(fs::path(HOPMESH_SOURCE_DIR) / link.path)) << page.path << ": " << link.path;
      EXPECT_TRUE(link.anchor.empty() || anchors_of(text_of(link.path)).count(link.anchor))
          << page.path << ": " << link.path << " has no heading #" << link.anchor;
    }
}

/// Whether a path, in whose last part a star may stand for anything, is in the tree.
bool is_in_tree(const std::string& path) {
  const fs::path whole = fs::path(HOPMESH_SOURCE_DIR) / path;
  if (path.find('*') == std::string::npos) return fs::exists(whole);
  const std::string shape = std::regex_replace(whole.filename().string(), std::regex("\\*"), ".*");
  for (const auto& entry : fs::directory_iterator(whole.parent_path()))
    if (std::regex_match(entry.path().filename().string(), std::regex(shape))) return true;
  return false;
}

TEST(Pages, namePlacesThatExist) {
  for (const TreeFile& page : tree_files({".md"}))
    for (const std::string& place : matches(page.text, "`((?:firmware|rtl_model|sim|tests|docs)/[^`\\s]*)`"))
      EXPECT_TRUE(is_in_tree(place)) << page.path << ": " << place;
}

TEST(Pages, thatCommentsAndMessagesNameExist) {
  for (const TreeFile& file :
       tree_files({".h", ".c", ".cpp", ".sv", ".js", ".toml", ".obj", ".txt", ".cmake"}))
    for (const std::string& page : matches(file.text, "(docs/[\\w/-]+\\.md)"))
      EXPECT_TRUE(is_in_tree(page)) << file.path << ": " << page;
}

TEST(Pages, sayWhomTheyAreForAndWhatTheyAnswer) {
  for (const TreeFile& page : tree_files({".md"})) {
    if (!starts_with(page.path, "docs/") || starts_with(page.path, "docs/decisions/")) continue;
    const std::size_t title = page.text.find("\n\n> For ");
    const bool opens = page.text[0] == '#' && title == page.text.find('\n');
    EXPECT_TRUE(opens) << page.path << " does not say whom it is for";
    if (!opens) continue;
    const std::string opening = page.text.substr(title, page.text.find("\n\n", title + 2) - title);
    EXPECT_TRUE(std::regex_search(opening, std::regex("This\\s(> )?page"))) << page.path << opening;
  }
}

TEST(Pages, standInTheIndex) {
  std::set<std::string> linked;
  for (const Link& link : links_of({"docs/README.md", text_of("docs/README.md")})) linked.insert(link.path);
  for (const TreeFile& page : tree_files({".md"}))
    EXPECT_TRUE(!starts_with(page.path, "docs/") || page.path == "docs/README.md" || linked.count(page.path))
        << page.path << " is not in docs/README.md";
}

TEST(Pages, ofTheFrontDoorAgreeAboutTheVersion) {
  std::smatch version;
  const std::string project = text_of("CMakeLists.txt");
  ASSERT_TRUE(std::regex_search(project, version, std::regex("project\\(hopmesh VERSION ([0-9.]+)")));
  EXPECT_NE(text_of("CITATION.cff").find("\nversion: " + version[1].str() + "\n"), std::string::npos);
  const std::string changes = text_of("CHANGELOG.md");
  EXPECT_EQ(changes.substr(changes.find("\n## ")).find("\n## " + version[1].str()), 0u) << "newest first";
}

} // namespace
} // namespace hopmesh::tests
