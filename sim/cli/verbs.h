// The table of verbs: each has a file of its own, and a row in verbs.cpp.
#pragma once

#include <CLI/CLI.hpp>

namespace hopmesh::cli {

/// Adds all verbs, in the groups in which the help lists them. The one that is called sets `exit_code`.
void add_verbs(CLI::App& program, int& exit_code);

} // namespace hopmesh::cli
