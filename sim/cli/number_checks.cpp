#include "sim/cli/number_checks.h"

#include "sim/input/number.h"

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

CLI::Validator positive_number() {
  return check<double>([](double x) { return x > 0 && std::isfinite(x); }, "a number above 0");
}

CLI::Validator share() {
  return check<double>([](double x) { return x > 0 && x < 1; }, "a number above 0 and below 1");
}

} // namespace hopmesh::cli
