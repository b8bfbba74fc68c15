// The statements of an OBJ file: a keyword and its words, without comments, with the lines joined that end in
// a backslash.
#pragma once

#include "sim/input/line_reader.h"

#include <string>

namespace hopmesh::scene {

class ObjLines {
 public:
  /// Keeps the view, not the text.
  explicit ObjLines(std::string_view text) : lines_(text) {}

  /// Goes to the next line's statement, which may be empty; false at the end of the text.
  bool next();
  std::string_view keyword() const { return keyword_; }
  /// What stands behind the keyword.
  input::Words words() const { return words_; }
  /// Of its first line, from 1.
  int number() const { return number_; }

 private:
  void join_lines();

  input::LineReader lines_;
  std::string joined_;
  std::string_view statement_, keyword_;
  input::Words words_{""};
  int number_ = 0;
};

} // namespace hopmesh::scene
