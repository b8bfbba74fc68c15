// The network of a step put to all solvers, and to the array before them.
#pragma once

#include "sim/networks/certainty.h"
#include "sim/networks/solvers/solver_runs.h"
#include "sim/networks/step_problem.h"
#include "sim/run/outcome.h"

#include <filesystem>
#include <map>

namespace hopmesh::networks {

struct SolvedStep {
  /// Failed: there is nothing to solve. Diverged: the motion does not come so far.
  run::Outcome outcome = run::Outcome::finished;
  std::string title, text; ///< for people; the text is empty where the user stopped it
  solvers::SolverRuns all;
  std::map<std::string, Certainty> certain; ///< of arrays stopped by the scene's rule, by the names of runs
};
/// `limits.gaps` fall. Throws input::InputError as step_problem() does.
SolvedStep solve_step(const levels::Prepared& prepared, std::uint64_t step, const StepStart& start,
                      const solvers::Limits& limits);

/// Methods that may be named in limits.only: those of this array, each with its corrected twin beside it, and
/// the solvers'.
std::vector<std::string> racer_names(const spec::ArraySpec& array);

/// Makes sure before any work that they can be written; throws files::WriteError.
void check_solver_files(const std::filesystem::path& folder);
/// solvers.csv, and solvers.svg, seconds.svg and multiplies.svg, which show `command`. Throws
/// files::WriteError.
void write_solver_files(const std::filesystem::path& folder, const SolvedStep& solved,
                        const std::vector<double>& gaps, const std::string& command);

} // namespace hopmesh::networks
