#include "tests/house/tree.h"

#include "place.h"

#include <algorithm>
#include <filesystem>
#include <regex>

namespace hopmesh::tests {

namespace {

namespace fs = std::filesystem;

const fs::path root = HOPMESH_SOURCE_DIR;

bool ends_as(const fs::path& path, const std::vector<std::string>& endings) {
  return endings.empty() || std::find(endings.begin(), endings.end(), path.extension()) != endings.end();
}

void take(const fs::directory_entry& entry, const std::vector<std::string>& endings,
          std::vector<TreeFile>& files) {
  const std::string path = entry.path().lexically_relative(root).string();
  if (entry.is_regular_file() && ends_as(entry.path(), endings)) files.push_back({path, text_of(path)});
}

} // namespace

std::string text_of(const std::string& path) {
  return fs::exists(root / path) ? content_of(root / path) : "";
}

std::vector<TreeFile> tree_files(const std::vector<std::string>& endings) {
  std::vector<TreeFile> files;
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().filename() != ".git") take(entry, endings, files); // a file where the tree is a worktree
  for (const char* room : {".ci", "docs", "firmware", "rtl_model", "sim", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) take(entry, endings, files);
  std::sort(files.begin(), files.end(), [](const TreeFile& a, const TreeFile& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex shape(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), shape), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

} // namespace hopmesh::tests
