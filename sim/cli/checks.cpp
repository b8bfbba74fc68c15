#include "sim/cli/checks.h"

#include "sim/input/input_error.h"
#include "sim/input/number.h"
#include "sim/input/utf8.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

template <class Number, class Good> CLI::Validator check(Good good, const std::string& expected) {
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

namespace {

/// Folders and waves are only opened under their name; every other word gets into files of results.
bool is_only_a_path(const CLI::Option& option) {
  return option.check_lname("out") || option.check_lname("resume") || option.check_lname("wave");
}

std::string fault_of(const CLI::Option& option, const std::string& text) {
  const bool flag = !option.get_positional();
  if (flag && text.empty()) return "found an empty value, expected " + option.get_description();
  if (!is_only_a_path(option) && !input::is_utf8(text))
    return fmt::format("found {}, expected UTF-8", input::in_quotes(text));
  double number = 0;
  const bool real = option.get_type_name().rfind("FLOAT", 0) == 0;
  if (real && input::parse_number(text, number) && !std::isfinite(number))
    return fmt::format("found {}, expected a finite number", text);
  return "";
}

} // namespace

void check_values(CLI::App& verb) {
  for (CLI::Option* option : verb.get_options([](const CLI::Option* o) { return o->get_type_size() > 0; })) {
    const auto judge = [option](const std::string& text) { return fault_of(*option, text); };
    option->check(CLI::Validator(judge, ""));
  }
}

} // namespace hopmesh::cli
