// The problem set: networks whose answer is known or can be judged, each made by a formula and a seed, the
// same on every machine. docs/findings/problem-set.md lists them.
#pragma once

#include "sim/files/matrix_market.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hopmesh::problems {

/// Least of E = -1/2 V'WV - I'V wanted, over the corners (binary) or the whole (modified) of the box [-1, 1].
struct Problem {
  std::string name;
  bool binary = false;
  files::SparseMatrix W; ///< symmetric
  std::vector<double> bias, start;
  std::optional<double> least_energy; ///< where the construction tells it
  /// What outputs mean, in a sentence.
  std::function<std::string(const std::vector<double>& V)> verdict;
};

/// In the order of the table in docs/findings/problem-set.md.
const std::vector<std::string>& names();

/// Throws input::InputError for a name that no problem has; `where` it stood.
void check_name(const std::string& name, const std::string& where);

/// A line about it. Throws std::out_of_range for a name that is none.
const std::string& about(const std::string& name);

/// `seed` chooses where the network starts (in a memory: pattern number seed, with noise of its own), never
/// the network. Throws as about() does.
Problem make(const std::string& name, std::uint64_t seed = 1);

/// W.mtx, bias.mtx and V0.mtx. Throws files::WriteError.
void write_problem(const std::filesystem::path& folder, const Problem& problem);

/// The pattern that a memory starts beside; empty for other problems.
std::vector<double> pattern_of(const std::string& name, std::uint64_t seed);

} // namespace hopmesh::problems
