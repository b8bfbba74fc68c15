#include "sim/networks/solved_step.h"

#include "sim/levels/interrupt.h"
#include "sim/networks/array_solver.h"
#include "sim/run/progress.h"

#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

/// Up to and with the step; `before` is what the step began from.
run::RunResult walk(levels::ReferenceMover& motion, std::uint64_t step, levels::StepState& before) {
  run::Progress progress(step + 1);
  run::RunResult result = run::simulate(motion, step, {&progress}, levels::stop_requested);
  before = motion.state();
  return run::simulate(motion, step + 1, {&progress}, levels::stop_requested, std::move(result));
}

std::string count_text(const std::optional<solvers::Reached>& reached) {
  return reached ? std::to_string(reached->sweeps) : "-";
}

std::string time_text(const std::optional<solvers::Reached>& reached) {
  return reached ? fmt::format("{:.3g}", 1e3 * reached->seconds) : "-";
}

std::string table_of(const solvers::SolverRuns& all, const std::vector<double>& gaps) {
  std::string heads;
  for (const double gap : gaps) heads += fmt::format("{:>9}", fmt::format("{:g}", gap));
  std::string table = fmt::format("{:<22}{}  |{}  factorisations\n", "", heads, heads);
  for (const solvers::SolverRun& solver_run : all.runs) {
    table += fmt::format("{:<22}", solver_run.name);
    for (const auto& reached : solver_run.reached) table += fmt::format("{:>9}", count_text(reached));
    table += "  |";
    for (const auto& reached : solver_run.reached) table += fmt::format("{:>9}", time_text(reached));
    table += fmt::format("  {}{}{}\n", solver_run.factorisations, solver_run.failure.empty() ? "" : "  ",
                         solver_run.failure);
  }
  return table;
}

std::string text_of(const SolvedStep& solved, const solvers::Problem& problem,
                    const std::vector<double>& gaps) {
  return fmt::format("{}: {} outputs, {} weights; {}\n"
                     "sweeps, then processor milliseconds (shared cores: a guide), until the energy's gap is "
                     "that part of the start's\n{}",
                     solved.title, problem.I.size(), problem.W.nonZeros(),
                     solved.all.answer.convex ? "convex, gaps to the exact answer"
                                              : "not convex, gaps to the lowest energy found",
                     table_of(solved.all, gaps));
}

/// False where the user stopped it.
bool race_all(const levels::Prepared& prepared, const solvers::Problem& whole, const solvers::Limits& limits,
              SolvedStep& solved) {
  const solvers::Problem problem = solvers::reached(whole);
  solved.all = solvers::solve_with_all(problem, limits, levels::stop_requested);
  if (levels::stop_requested) return false;
  if (solved.all.runs.empty()) {
    solved.outcome = run::Outcome::failed;
    solved.text = solved.title + ": the network starts at its rest; there is nothing to solve\n";
    return true;
  }
  StepArray array(whole, prepared);
  solved.all.runs.insert(solved.all.runs.begin(),
                         run_array(array, problem, solved.all.answer, limits, levels::stop_requested));
  if (levels::stop_requested) return false;
  solved.text = text_of(solved, problem, limits.gaps) +
                stall_text(array, solved.all.runs.front(), problem, solved.all.answer);
  return true;
}

} // namespace

SolvedStep solve_step(const levels::Prepared& prepared, std::uint64_t step, const StepStart& start,
                      const solvers::Limits& limits) {
  SolvedStep solved;
  solved.title = fmt::format("{} step {}", prepared.inputs.scene.name, step);
  levels::ReferenceMover motion(prepared.inputs.scene, *prepared.mesh, prepared.inputs.array);
  levels::catch_interrupts();
  levels::StepState before;
  const run::RunResult walked = walk(motion, step, before);
  solved.outcome = walked.outcome;
  if (walked.rows.size() <= step) {
    if (walked.outcome != run::Outcome::interrupted) solved.text = walked.sentence + '\n';
    return solved;
  }
  solved.outcome = run::Outcome::finished;
  try {
    if (!race_all(prepared, step_problem(motion, before, prepared, start), limits, solved))
      solved.outcome = run::Outcome::interrupted;
  } catch (const levels::Stopped&) {
    solved.outcome = run::Outcome::interrupted;
  }
  return solved;
}

} // namespace hopmesh::networks
