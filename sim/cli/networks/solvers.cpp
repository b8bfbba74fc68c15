// hopmesh solvers: other ways to the answer of one step's network, beside the network's own and the array's.
#include "sim/cli/options.h"
#include "sim/networks/solved_step.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct SolversOptions {
  input::InputWords words;
  std::int64_t step = 0, max_sweeps = 20000;
  std::vector<double> gaps{1e-2, 1e-4, 1e-6};
  std::vector<std::string> only;
  std::string out;
  networks::StepStart start;
};

std::string command_of(const SolversOptions& o) {
  std::string command = fmt::format("hopmesh solvers {} --step {}", text_of(o.words), o.step);
  if (o.start.cold) command += " --cold";
  if (o.start.still) command += " --still";
  if (o.start.time_step > 0) command += fmt::format(" --time-step {}", o.start.time_step);
  return command;
}

int solvers(SolversOptions& o) {
  std::sort(o.gaps.rbegin(), o.gaps.rend());
  if (const auto twice = std::adjacent_find(o.gaps.begin(), o.gaps.end()); twice != o.gaps.end())
    throw input::input_error("", 0, "--gap", fmt::format("{:g} twice", *twice), "each gap once");
  const levels::Prepared p = prepare(o.words);
  check_step(o.step, p);
  for (const std::string& name : o.only) check_name(name, "--only", networks::racer_names(p.inputs.array));
  const std::filesystem::path folder = o.out;
  if (!o.out.empty()) networks::check_solver_files(folder);
  const networks::SolvedStep solved =
      networks::solve_step(p, static_cast<std::uint64_t>(o.step), o.start,
                           {o.gaps, static_cast<std::uint64_t>(o.max_sweeps), false, o.only});
  fmt::print("{}", solved.text);
  if (solved.outcome == run::Outcome::finished && !o.out.empty()) {
    networks::write_solver_files(folder, solved, o.gaps, command_of(o));
    fmt::print("Results\n  {}\n  {}\n", (folder / "solvers.csv").string(), (folder / "solvers.svg").string());
  }
  return exit_of(solved.outcome);
}

} // namespace

void add_solvers(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<SolversOptions>();
  CLI::App* verb =
      program.add_subcommand("solvers", "other solvers of one step's network, beside its own rule");
  add_common(*verb, o->words);
  verb->add_option("--step", o->step, "the step, counted from 0")->required()->check(whole_number(0));
  verb->add_option("--gap", o->gaps, "parts of the start's energy gap to be reached (1e-2,1e-4,1e-6)")
      ->delimiter(',')
      ->check(share());
  verb->add_option("--max-sweeps", o->max_sweeps, "where a method gives up (20000)")->check(whole_number(1));
  verb->add_option("--only", o->only,
                   "these methods alone, as the table names them; an array's brings its "
                   "corrected one along")
      ->delimiter(',');
  auto* cold = verb->add_flag("--cold", o->start.cold, "start from zero, not from the step before");
  auto* still = verb->add_flag("--still", o->start.still,
                               "start from where the mesh stands, and expand the energy there (incremental)");
  still->excludes(cold);
  verb->add_option("--time-step", o->start.time_step, "of the step asked about, if not the motion's; s")
      ->check(positive_number())
      ->needs(still);
  verb->add_option("--out", o->out, "folder for solvers.csv, solvers.svg, seconds.svg, multiplies.svg");
  verb->footer("Example:\n  hopmesh solvers banner --step 10 --out out/solvers");
  verb->callback([o, &exit_code] { exit_code = solvers(*o); });
}

} // namespace hopmesh::cli
