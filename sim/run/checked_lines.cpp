#include "sim/run/checked_lines.h"

#include "sim/input/number.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace hopmesh::run {

namespace {

constexpr std::size_t check_digits = 16;

std::uint64_t check_of(std::string_view line, std::uint64_t before) {
  return XXH64(line.data(), line.size(), before);
}

} // namespace

std::string_view first_word(std::string_view& text) {
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return word;
}

void CheckedLines::add(const std::string& key, const std::string& value) {
  const std::string line = key + ' ' + value;
  check_ = check_of(line, check_);
  text_ += fmt::format("{:016x} {}\n", check_, line);
}

input::InputError CheckedLineReader::error(const std::string& key, const std::string& found,
                                           const std::string& expected) const {
  return input::input_error(file_, line_, key, found, expected);
}

bool CheckedLineReader::next_is(const std::string& key) const {
  const std::string_view line = rest_.substr(0, rest_.find('\n'));
  return line.size() > check_digits && line.compare(check_digits, key.size() + 2, ' ' + key + ' ') == 0;
}

std::string_view CheckedLineReader::value(const std::string& key) {
  ++line_;
  const std::size_t end = rest_.find('\n');
  if (end == std::string_view::npos || end <= check_digits)
    throw error(key, end == std::string_view::npos ? "the end of the file" : "a line cut short",
                "a line with its check");
  const std::string_view digits = rest_.substr(0, check_digits), blank = rest_.substr(check_digits, 1);
  std::string_view text = rest_.substr(check_digits + 1, end - check_digits - 1);
  const std::uint64_t check = check_of(text, check_);
  if (digits != fmt::format("{:016x}", check) || blank != " ")
    throw error("", "a damaged line, check " + input::in_quotes(digits), fmt::format("{:016x}", check));
  const std::string_view found = first_word(text);
  if (found != key) throw error("", "key " + input::in_quotes(found), "key \"" + key + '"');
  check_ = check;
  rest_ = rest_.substr(end + 1);
  return text;
}

std::uint64_t CheckedLineReader::count(const std::string& key) {
  const std::string_view text = value(key);
  std::uint64_t number = 0;
  if (!input::parse_number(text, number)) throw error(key, input::in_quotes(text), "a number");
  return number;
}

} // namespace hopmesh::run
