// Checks for numbers on the command line: what is refused is told in words that fit a line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace hopmesh::cli {

/// An integer from `least` to `most`, which is by default as many steps as a scene may have.
CLI::Validator whole_number(std::int64_t least, std::int64_t most = 1'000'000'000);
/// A finite number above 0.
CLI::Validator positive_number();
/// A number above 0 and below 1.
CLI::Validator share();

} // namespace hopmesh::cli
