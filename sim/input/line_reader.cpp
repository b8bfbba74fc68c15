#include "sim/input/line_reader.h"

#include <algorithm>

namespace hopmesh::input {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

} // namespace

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

LineReader::LineReader(std::string_view text) : text_(text) {
  if (text_.substr(0, byte_order_mark.size()) == byte_order_mark) text_.remove_prefix(byte_order_mark.size());
  feed_ = std::min(text_.size(), text_.find('\n'));
}

// The next \n is looked for once, not once a line: a file may have none.
bool LineReader::next() {
  if (at_ >= text_.size()) return false;
  if (feed_ < at_) feed_ = std::min(text_.size(), text_.find('\n', at_));
  line_ = text_.substr(at_, feed_ - at_);
  line_ = line_.substr(0, line_.find('\r'));
  at_ += line_.size();
  at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++number_;
  return true;
}

std::string_view Words::rest() const {
  const auto first = std::find_if_not(rest_.begin(), rest_.end(), is_blank);
  return rest_.substr(static_cast<std::size_t>(first - rest_.begin()));
}

std::string_view Words::next() {
  rest_ = rest();
  const auto end = std::find_if(rest_.begin(), rest_.end(), is_blank);
  const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
  rest_.remove_prefix(word.size());
  return word;
}

} // namespace hopmesh::input
