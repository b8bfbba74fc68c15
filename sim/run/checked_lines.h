// Text of which every line carries a check of itself and of all lines before it: whatever is damaged, lost or
// mixed in is found at its line.
#pragma once

#include "sim/input/input_error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace hopmesh::run {

/// Writes "CHECK key value" lines; CHECK is 16 hexadecimal digits (XXH64).
class CheckedLines {
 public:
  void add(const std::string& key, const std::string& value);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::uint64_t check_ = 0;
};

/// Reads them in order. Everything that is not as it was written is a input::InputError with file and line.
class CheckedLineReader {
 public:
  /// Keeps both; `text` may go on behind the lines.
  CheckedLineReader(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  /// The next line, which must have this key.
  std::string_view value(const std::string& key);
  /// The next line, which must have this key and a number.
  std::uint64_t count(const std::string& key);
  bool next_is(const std::string& key) const;
  /// Of the line that was read last.
  int line() const { return line_; }
  std::string_view rest() const { return rest_; }
  input::InputError error(const std::string& key, const std::string& found,
                          const std::string& expected) const;

 private:
  std::string_view rest_;
  const std::string file_;
  std::uint64_t check_ = 0;
  int line_ = 0;
};

/// Up to the next space; takes it off the text.
std::string_view first_word(std::string_view& text);

} // namespace hopmesh::run
