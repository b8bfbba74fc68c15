#include "sim/input/number.h"

#include <charconv>

namespace hopmesh::input {

namespace {

template <class Number, class... Base> bool parse(std::string_view text, Number& value, Base... base) {
  Number found{};
  const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), found, base...);
  if (failure != std::errc() || stop != text.data() + text.size()) return false;
  value = found;
  return true;
}

} // namespace

bool parse_number(std::string_view text, std::uint64_t& value, int base) {
  return parse(text, value, base);
}

bool parse_number(std::string_view text, std::int64_t& value) {
  return parse(text, value);
}

bool parse_number(std::string_view text, double& value) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return parse(text.substr(plus ? 1 : 0), value);
}

} // namespace hopmesh::input
