// Folders of a test's own, and files and texts as tests read and write them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hopmesh::tests {

/// A folder of a test's own, gone when the test ends.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  bool empty() const { return std::filesystem::is_empty(path_); }
  /// The path of a new file with that text.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// Throws std::runtime_error where there is no such file.
std::string content_of(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);
/// Names of everything in a folder, ascending.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// A text that ends with `at` has an empty part behind it.
std::vector<std::string> split(const std::string& text, char at);
/// The last line may end with the text.
std::vector<std::string> lines_of(const std::string& text);

} // namespace hopmesh::tests
