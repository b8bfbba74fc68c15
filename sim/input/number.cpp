#include "sim/input/number.h"

#include <algorithm>
#include <charconv>
#include <string>

namespace hopmesh::input {

namespace {

template <class Number, class... Base> bool parse(std::string_view text, Number& value, Base... base) {
  Number found{};
  const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), found, base...);
  if (failure != std::errc() || stop != text.data() + text.size()) return false;
  value = found;
  return true;
}

/// The power of ten of the first digit that is not 0.
std::int64_t power_of(std::string_view digits) {
  const auto point = static_cast<std::int64_t>(std::min(digits.size(), digits.find('.')));
  const auto first = static_cast<std::int64_t>(std::min(digits.size(), digits.find_first_of("123456789")));
  return first < point ? point - 1 - first : point - first;
}

/// The exponent behind the e; far where it is one of many digits.
std::int64_t exponent_of(std::string_view text) {
  constexpr std::int64_t far = std::int64_t{1} << 60;
  if (text.empty()) return 0;
  const bool minus = text[0] == '-';
  if (minus || text[0] == '+') text.remove_prefix(1);
  std::int64_t exponent = far;
  parse(text, exponent);
  exponent = std::min(exponent, far);
  return minus ? -exponent : exponent;
}

/// Of a number that does not fit: whether it is smaller than the smallest, not larger than the largest.
bool is_tiny(std::string_view text) {
  const std::size_t e = std::min(text.size(), text.find_first_of("eE"));
  return power_of(text.substr(0, e)) + exponent_of(text.substr(std::min(text.size(), e + 1))) < 0;
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
  if (plus) text.remove_prefix(1);
  double found = 0;
  const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), found);
  if (failure == std::errc::invalid_argument || stop != text.data() + text.size()) return false;
  const bool minus = !text.empty() && text[0] == '-';
  if (failure == std::errc::result_out_of_range && !is_tiny(text.substr(minus ? 1 : 0))) return false;
  value = failure == std::errc() ? found : minus ? -0.0 : 0.0;
  return true;
}

bool parse_real(std::string_view text, double& value) {
  if (parse_number(text, value)) return true;
  std::string with_e(text);
  const std::size_t d = with_e.find_first_of("dD");
  if (d == std::string::npos || d == 0) return false;
  with_e[d] = 'e';
  return parse_number(with_e, value);
}

} // namespace hopmesh::input
