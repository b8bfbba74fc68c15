// A text taken apart line by line, and a line word by word.
#pragma once

#include <string_view>

namespace hopmesh::input {

class LineReader {
 public:
  /// Keeps the view, not the text.
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// Goes to the next line; false at the end of the text.
  bool next();
  /// The line at hand, without its end (\n or \r\n), and its number from 1.
  std::string_view line() const { return line_; }
  int number() const { return number_; }

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

/// Words with blanks or tabs between them.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  /// The next word; empty at the end.
  std::string_view next();
  /// The words that are left, with all that stands between them.
  std::string_view rest() const;

 private:
  std::string_view rest_;
};

} // namespace hopmesh::input
