#include "sim/networks/solved_step.h"

#include "rtl_model/spec/array_spec.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/reference_check.h"
#include "sim/networks/array_solver.h"
#include "sim/run/progress.h"

#include <algorithm>
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

std::string hardware_text(const std::optional<solvers::Reached>& reached) {
  return reached && reached->hardware ? fmt::format("{:.3g}", 1e3 * reached->hardware->seconds) : "-";
}

std::string table_of(const solvers::SolverRuns& all, const std::vector<double>& gaps) {
  std::string heads;
  for (const double gap : gaps) heads += fmt::format("{:>9}", fmt::format("{:g}", gap));
  std::string table = fmt::format("{:<26}{}  |{}  |{}  factorisations\n", "", heads, heads, heads);
  for (const solvers::SolverRun& solver_run : all.runs) {
    table += fmt::format("{:<26}", solver_run.name);
    for (const auto& reached : solver_run.reached) table += fmt::format("{:>9}", count_text(reached));
    table += "  |";
    for (const auto& reached : solver_run.reached) table += fmt::format("{:>9}", time_text(reached));
    table += "  |";
    for (const auto& reached : solver_run.reached) table += fmt::format("{:>9}", hardware_text(reached));
    table += fmt::format("  {}{}{}\n", solver_run.factorisations, solver_run.failure.empty() ? "" : "  ",
                         solver_run.failure);
  }
  return table;
}

std::string text_of(const SolvedStep& solved, const solvers::Problem& problem,
                    const std::vector<double>& gaps) {
  return fmt::format("{}: {} outputs, {} weights; {}\n"
                     "sweeps, then processor milliseconds (shared cores: a guide), then milliseconds of an "
                     "array's clock, bus included, until the energy's gap is that part of the start's\n{}",
                     solved.title, problem.I.size(), problem.W.nonZeros(),
                     solved.all.answer.convex ? "convex, gaps to the exact answer"
                                              : "not convex, gaps to the lowest energy found",
                     table_of(solved.all, gaps));
}

/// An array of the race, by the name of its row.
struct Entrant {
  std::string name;
  spec::ArraySpec array;
};

bool corrects(const spec::ArraySpec& array) {
  return array.output != spec::Output::binary && array.normaliser != spec::Normaliser::prescaled;
}

/// The array as it is, and with every other output stage that steps: momentum fires all at once.
std::vector<Entrant> entrants(const spec::ArraySpec& given) {
  std::vector<Entrant> all{{"array", given}};
  if (!corrects(given)) return all;
  for (const auto output : {spec::Output::modified, spec::Output::projected, spec::Output::momentum}) {
    if (output == given.output) continue;
    spec::ArraySpec array = given;
    array.output = output;
    const bool at_once = output == spec::Output::momentum;
    if (at_once || array.schedule == spec::Schedule::synchronous)
      array.schedule = at_once ? spec::Schedule::synchronous : spec::Schedule::coloured;
    array.pipeline = std::min(array.pipeline, spec::most_pipeline(array));
    all.push_back({"array_" + std::string(spec::name_of(output)), array});
  }
  return all;
}

/// What all arrays of a race are put to.
struct Race {
  const levels::Prepared& prepared;
  const solvers::Problem &whole, &problem;
  const solvers::Limits& limits;
  SolvedStep& solved;
};

levels::RunRules rules_of(const levels::Prepared& p, const spec::ArraySpec& array) {
  levels::RunRules rules = levels::rules_of(levels::motion_for(p.inputs.scene, array));
  rules.loads = true;
  return rules;
}

/// Stopped by the scene's rule: how sure its answer is, against the step's network and the loaded one.
std::string certain_text(const Race& race, const Entrant& entrant) {
  StepArray array(race.whole, race.prepared, entrant.array);
  const spec::Relaxation run = array.rest();
  const auto order = levels::order_for(*race.prepared.mesh, entrant.array.schedule);
  levels::RunRules rules = rules_of(race.prepared, entrant.array);
  const auto look = [&](const solvers::Problem& problem) {
    const levels::ErrorBounds bounds({problem.W, problem.I}, order, true);
    return certainty_of(problem, array.whole_outputs(), bounds, entrant.array,
                        run.converged ? std::optional(rules) : std::nullopt);
  };
  const Certainty& asked = race.solved.certain[entrant.name] = look(race.whole);
  std::string text = fmt::format(
      "{}: {} after {}, {}\n", entrant.name, run.converged ? "at rest by the scene's rule" : "not at rest",
      input::with_noun(run.sweeps, "sweep"), told_text(asked) + "; " + bound_text(asked.bound));
  rules.loads = false;
  if (const auto loaded = array.loaded()) {
    const Certainty inside = look(*loaded);
    text += fmt::format("  in the network as loaded: {}; {}\n", told_text(inside), bound_text(inside.bound));
  }
  return text;
}

/// Puts an array's row, and that of its corrected answers, before the solvers'; what is said of it.
std::string race_array(const Race& race, const Entrant& entrant, std::size_t& place) {
  auto& runs = race.solved.all.runs;
  const auto& answer = race.solved.all.answer;
  const auto& stop = levels::stop_requested;
  const std::string with_corrections = entrant.name + "_corrected";
  if (!solvers::runs(race.limits, entrant.name) && !solvers::runs(race.limits, with_corrections)) return "";
  StepArray plain(race.whole, race.prepared, entrant.array),
      corrected(race.whole, race.prepared, entrant.array);
  runs.insert(runs.begin() + place++,
              run_array(entrant.name, plain, race.problem, answer, race.limits, stop));
  std::string text = place == 1 ? stall_text(plain, runs.front(), race.problem, answer) : "";
  if (!corrects(entrant.array) || stop) return text;
  runs.insert(runs.begin() + place++, run_corrected(with_corrections, corrected, race.whole, race.problem,
                                                    answer, race.limits, stop));
  return stop ? text : text + certain_text(race, entrant);
}

/// False where the user stopped it.
bool race_all(const levels::Prepared& prepared, const solvers::Problem& whole, const solvers::Limits& limits,
              SolvedStep& solved) {
  const solvers::Problem problem = solvers::reached(whole);
  solved.all = solvers::solve_with_all(problem, limits, levels::stop_requested);
  if (levels::stop_requested) return false;
  if (!(solved.all.answer.start_gap > 0)) {
    solved.outcome = run::Outcome::failed;
    solved.text = solved.title + ": the network starts at its rest; there is nothing to solve\n";
    return true;
  }
  const Race race{prepared, whole, problem, limits, solved};
  std::string told;
  std::size_t place = 0;
  for (const Entrant& entrant : entrants(prepared.inputs.array)) {
    told += race_array(race, entrant, place);
    if (levels::stop_requested) return false;
  }
  solved.text = text_of(solved, problem, limits.gaps) + told;
  return true;
}

} // namespace

std::vector<std::string> racer_names(const spec::ArraySpec& array) {
  std::vector<std::string> all;
  for (const Entrant& entrant : entrants(array)) {
    all.push_back(entrant.name);
    if (corrects(entrant.array)) all.push_back(entrant.name + "_corrected");
  }
  const auto& others = solvers::solver_names();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

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
