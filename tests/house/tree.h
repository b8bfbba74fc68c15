// The source tree as text, for tests that read it.
#pragma once

#include "tests/support/files.h"

namespace hopmesh::tests {

/// A file of the tree; `path` is from the root.
struct TreeFile {
  std::string path, text;
};

/// The files of the rooms and of the root, build and result folders left out, in order of their paths. With
/// endings (".h"), only those.
std::vector<TreeFile> tree_files(const std::vector<std::string>& endings = {});

/// The text of one file; empty where there is none.
std::string text_of(const std::string& path);

/// The first group of a pattern wherever a text matches it, in order.
std::vector<std::string> matches(const std::string& text, const char* pattern);
bool starts_with(const std::string& text, const std::string& start);

} // namespace hopmesh::tests
