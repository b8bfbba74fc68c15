// What is wrong with a command line, in our own words.
#pragma once

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

std::vector<std::string> verb_names(const CLI::App& program);
/// A sentence for a command line that cannot be understood.
std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

} // namespace hopmesh::cli
