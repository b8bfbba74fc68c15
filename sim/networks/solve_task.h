// What `solve` is given: a network of files, or one of the problem set, and an array that it fits.
#pragma once

#include "sim/levels/level.h"
#include "sim/networks/network_files.h"
#include "sim/networks/solution.h"

#include <functional>

namespace hopmesh::networks {

struct SolveTask {
  std::string name;
  NetworkData data;
  std::string rule; ///< output stage that the network wants; empty: the array's
  std::function<std::string(const std::vector<double>&)> verdict; ///< of outputs; empty: nobody knows
};

/// `files.weights` may name a problem, whose start `seed` chooses; 0: nobody said. Throws input::InputError.
SolveTask read_task(const NetworkFiles& files, std::int64_t seed);

/// Rules are output stages of an array under the paper's names.
std::vector<std::string> rule_names();
/// Gives the array the rule that was asked for, else the task's. `is_set`: the array's own was asked for too,
/// and must not contradict. Throws input::InputError.
void apply_rule(const std::string& rule, bool is_set, const SolveTask& task, spec::ArraySpec& array);

/// How a task ended.
struct TaskEnd {
  std::string text; ///< for people
  bool at_rest;
  std::vector<std::string> notes; ///< about the array and this network: a line each
};
/// Relaxes it at a level and corrects the answer by its residual, at most so often; into `folder`, unless
/// that is empty, go V.mtx, solve.csv and summary.json. Throws input::InputError where the array (of `file`)
/// cannot have the network, levels::Stopped where the user stops an array, and files::WriteError.
TaskEnd solve_task(const SolveTask& task, const spec::ArraySpec& array, const std::string& file,
                   const levels::Level& level, const levels::RelaxOptions& options,
                   const std::filesystem::path& folder, std::uint32_t refinements);

} // namespace hopmesh::networks
