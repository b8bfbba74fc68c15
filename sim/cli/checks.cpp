#include "sim/cli/checks.h"

#include "sim/input/input_error.h"
#include "sim/input/number.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

template <class Number, class Good> CLI::Validator check(Good good, std::string expected) {
  const auto judge = [good, expected](const std::string& text) {
    Number number = 0;
    if (input::parse_number(text, number) && good(number)) return std::string();
    return fmt::format("found {}, expected {}", text, expected);
  };
  return {judge, ""};
}

} // namespace

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  return check<std::int64_t>([=](std::int64_t n) { return n >= least && n <= most; },
                             fmt::format("an integer from {} to {}", least, most));
}

CLI::Validator number_in(double least, double most) {
  return check<double>([=](double x) { return x >= least && x <= most; },
                       fmt::format("a number from {} to {}", least, most));
}

CLI::Validator positive_number() {
  return check<double>([](double x) { return x > 0 && std::isfinite(x); }, "a number above 0");
}

CLI::Validator share() {
  return check<double>([](double x) { return x > 0 && x < 1; }, "a number above 0 and below 1");
}

CLI::Validator one_name_of(const std::vector<std::string>& names) {
  const auto judge = [=](const std::string& text) {
    if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
    const std::string nearest = input::nearest_name(text, names);
    return fmt::format("found {}, expected {}{}", text, fmt::join(names, ", "),
                       nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest));
  };
  return {judge, ""};
}

void check_name(const std::string& name, const std::string& flag, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw input::input_error("", 0, flag, name, fmt::format("{}", fmt::join(names, ", ")),
                             input::nearest_name(name, names));
}

} // namespace hopmesh::cli
