#include "sim/input/line_reader.h"

#include <algorithm>

namespace hopmesh::input {

namespace {

constexpr const char* blanks = " \t\r";

} // namespace

bool LineReader::next() {
  if (rest_.empty()) return false;
  line_ = rest_.substr(0, rest_.find('\n'));
  rest_.remove_prefix(std::min(rest_.size(), line_.size() + 1));
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view Words::rest() const {
  return rest_.substr(std::min(rest_.size(), rest_.find_first_not_of(blanks)));
}

std::string_view Words::next() {
  rest_ = rest();
  const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
  rest_.remove_prefix(word.size());
  return word;
}

} // namespace hopmesh::input
