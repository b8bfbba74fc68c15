// C and C++ as tests of the tree read it: comments and strings taken out of the code, functions found by
// their braces.
#pragma once

#include "tests/support/files.h"

#include <cstddef>

namespace hopmesh::tests {

/// A piece of a file, and the line where it begins.
struct Piece {
  std::size_t line;
  std::string text;
};

struct Code {
  std::string bare;            ///< blanks where comments and strings stood; lines as in the file
  std::vector<Piece> comments; ///< comments on lines of their own that follow each other are one
  std::vector<Piece> strings;  ///< what stands between the quotes, as written
};

Code code_of(const std::string& text);

struct Function {
  std::size_t line;
  std::size_t lines; ///< from its head to its last brace
};

/// Functions at the level of namespaces and classes, of code in the format of .clang-format.
std::vector<Function> functions_of(const Code& code);

/// The sentences of a comment.
std::vector<std::string> sentences_of(const std::string& comment);

} // namespace hopmesh::tests
