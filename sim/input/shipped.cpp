#include "sim/input/shipped.h"

#include "sim/input/input_error.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <regex>

namespace hopmesh::input {

namespace {

namespace fs = std::filesystem;

// An installation may have been moved, or the tree it came from be gone.
fs::path data_folder() {
  std::error_code ignored;
  const fs::path beside =
      fs::read_symlink("/proc/self/exe", ignored).parent_path() / HOPMESH_DATA_FROM_PROGRAM;
  for (const fs::path& folder : {beside, fs::path(HOPMESH_DATA)})
    if (fs::is_directory(folder / "scenes", ignored)) return folder.lexically_normal();
  return HOPMESH_INSTALLED_DATA;
}

} // namespace

std::string shipped_folder(Shipped kind) {
  return (data_folder() / (kind == Shipped::scene ? "scenes" : "studies")).string();
}

std::vector<std::string> shipped_names(Shipped kind) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(shipped_folder(kind), ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string about_shipped(const std::string& name, Shipped kind) {
  std::ifstream file(fs::path(shipped_folder(kind)) / (name + ".toml"));
  std::string comment;
  for (std::string line; std::getline(file, line) && line.rfind("# ", 0) == 0;) comment += line.substr(1);
  static const std::regex sentence(" (.*?[.:])( [A-Z].*)?");
  std::smatch part;
  return std::regex_match(comment, part, sentence) ? part[1].str() : comment;
}

std::string path_of(const std::string& word, Shipped kind) {
  const std::vector<std::string> names = shipped_names(kind);
  if (std::binary_search(names.begin(), names.end(), word))
    return (fs::path(shipped_folder(kind)) / (word + ".toml")).string();
  std::error_code ignored;
  const bool is_path = word.find('/') != std::string::npos || fs::path(word).extension() == ".toml";
  if (is_path || fs::is_regular_file(word, ignored)) return word;
  const std::string what = kind == Shipped::scene ? "scene" : "study";
  throw input_error("", 0, what, in_quotes(word),
                    fmt::format("a {} file, or one of {}", what, fmt::join(names, ", ")),
                    nearest_name(word, names));
}

} // namespace hopmesh::input
