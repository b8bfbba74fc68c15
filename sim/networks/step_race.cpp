#include "sim/networks/step_race.h"

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

std::string text_of(const StepRace& race, const solvers::Problem& problem, const std::vector<double>& gaps) {
  return fmt::format("{}: {} outputs, {} weights; {}\n"
                     "sweeps, then processor milliseconds (shared cores: a guide), until the energy's gap is "
                     "that part of the start's\n{}",
                     race.title, problem.I.size(), problem.W.nonZeros(),
                     race.all.answer.convex ? "convex, gaps to the exact answer"
                                            : "not convex, gaps to the lowest energy found",
                     table_of(race.all, gaps));
}

/// False where the user stopped it.
bool race_all(const levels::Prepared& prepared, const solvers::Problem& whole, const solvers::Limits& limits,
              StepRace& race) {
  const solvers::Problem problem = solvers::reached(whole);
  race.all = solvers::solve_with_all(problem, limits, levels::stop_requested);
  if (levels::stop_requested) return false;
  if (race.all.runs.empty()) {
    race.outcome = run::Outcome::failed;
    race.text = race.title + ": the network starts at its rest; there is nothing to solve\n";
    return true;
  }
  StepArray array(whole, prepared);
  race.all.runs.insert(race.all.runs.begin(),
                       run_array(array, problem, race.all.answer, limits, levels::stop_requested));
  if (levels::stop_requested) return false;
  race.text = text_of(race, problem, limits.gaps) +
              stall_text(array, race.all.runs.front(), problem, race.all.answer);
  return true;
}

} // namespace

StepRace race_on_step(const levels::Prepared& prepared, std::uint64_t step, const StepStart& start,
                      const solvers::Limits& limits) {
  StepRace race;
  race.title = fmt::format("{} step {}", prepared.inputs.scene.name, step);
  levels::ReferenceMover motion(prepared.inputs.scene, *prepared.mesh, prepared.inputs.array);
  levels::catch_interrupts();
  levels::StepState before;
  const run::RunResult walked = walk(motion, step, before);
  race.outcome = walked.outcome;
  if (walked.rows.size() <= step) {
    if (walked.outcome != run::Outcome::interrupted) race.text = walked.sentence + '\n';
    return race;
  }
  race.outcome = run::Outcome::finished;
  try {
    if (!race_all(prepared, step_problem(motion, before, prepared, start), limits, race))
      race.outcome = run::Outcome::interrupted;
  } catch (const levels::Stopped&) {
    race.outcome = run::Outcome::interrupted;
  }
  return race;
}

} // namespace hopmesh::networks
