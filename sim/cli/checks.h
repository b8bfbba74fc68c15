// Checks of what stands on a command line: what is refused is told in words that fit a line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace hopmesh::cli {

/// An integer from `least` to `most`, which is by default as many steps as a scene may have.
CLI::Validator whole_number(std::int64_t least, std::int64_t most = 1'000'000'000);
/// A number from `least` to `most`.
CLI::Validator number_in(double least, double most);
/// A finite number above 0.
CLI::Validator positive_number();
/// A number above 0 and below 1.
CLI::Validator share();
/// A name out of a few.
CLI::Validator one_name_of(const std::vector<std::string>& names);

/// What no flag of a verb takes, whatever its meaning: an empty value (of a shell's variable that is not
/// set), bytes that are no UTF-8 where they would get into results, a number that is none.
void check_values(CLI::App& verb);

/// Throws input::InputError for a name that is none of `names`; `flag` is where it stood.
void check_name(const std::string& name, const std::string& flag, const std::vector<std::string>& names);

} // namespace hopmesh::cli
