// A text taken apart line by line, and a line word by word.
#pragma once

#include <string_view>

namespace hopmesh::input {

class LineReader {
 public:
  /// Keeps the view, not the text. A byte order mark (of UTF-8) at its beginning is no part of the first
  /// line.
  explicit LineReader(std::string_view text);

  /// Goes to the next line; false at the end of the text.
  bool next();
  /// The line at hand, without its end (\n, \r\n or, from old programs, \r alone), and its number from 1.
  std::string_view line() const { return line_; }
  int number() const { return number_; }

 private:
  std::string_view text_, line_;
  std::size_t at_ = 0, feed_ = 0; ///< where the next line begins; the first \n from there on
  int number_ = 0;
};

/// What stands between words: blanks, tabs, vertical tabs, form feeds and stray carriage returns.
bool is_blank(char c);

/// Words with blanks between them.
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
