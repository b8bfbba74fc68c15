// What is wrong with a command line, in our own words.
#pragma once

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

std::vector<std::string> verb_names(const CLI::App& program);
/// A sentence for a command line that cannot be understood.
std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

/// What no flag of a verb takes, whatever its meaning: an empty value (of a shell's variable that is not
/// set), bytes that are no UTF-8 where they would get into results, a number that is none.
void check_values(CLI::App& verb);

/// A check for a number from `least` to `most`, refused in our words.
CLI::Validator number_in(double least, double most);
/// A check for one of a few names.
CLI::Validator one_name_of(const std::vector<std::string>& names);

} // namespace hopmesh::cli
