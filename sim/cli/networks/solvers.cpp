// hopmesh solvers: other ways to the answer of one step's network, beside the network's own and the array's.
#include "sim/cli/options.h"
#include "sim/files/csv.h"
#include "sim/levels/interrupt.h"
#include "sim/networks/array_solver.h"
#include "sim/networks/step_problem.h"
#include "sim/pictures/svg_chart.h"
#include "sim/run/progress.h"
#include "sim/run/simulation.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct SolversOptions {
  CommonOptions common;
  std::int64_t step = 0, max_sweeps = 20000;
  std::vector<double> gaps{1e-2, 1e-4, 1e-6};
  std::string out;
  networks::StepStart start;
};

std::string count_text(const std::optional<solvers::Reached>& reached) {
  return reached ? std::to_string(reached->sweeps) : "-";
}

std::string time_text(const std::optional<solvers::Reached>& reached) {
  return reached ? fmt::format("{:.3g}", 1e3 * reached->seconds) : "-";
}

void print_table(const solvers::SolverRuns& all, const std::vector<double>& gaps) {
  fmt::print("{:<22}", "");
  for (const double gap : gaps) fmt::print("{:>9}", fmt::format("{:g}", gap));
  fmt::print("  |");
  for (const double gap : gaps) fmt::print("{:>9}", fmt::format("{:g}", gap));
  fmt::print("  factorisations\n");
  for (const solvers::SolverRun& solver_run : all.runs) {
    fmt::print("{:<22}", solver_run.name);
    for (const auto& reached : solver_run.reached) fmt::print("{:>9}", count_text(reached));
    fmt::print("  |");
    for (const auto& reached : solver_run.reached) fmt::print("{:>9}", time_text(reached));
    fmt::print("  {}{}{}\n", solver_run.factorisations, solver_run.failure.empty() ? "" : "  ",
               solver_run.failure);
  }
}

void write_csv(const solvers::SolverRuns& all, const std::vector<double>& gaps,
               const std::filesystem::path& path) {
  std::vector<std::string> columns{"method"};
  for (const char* kind : {"sweeps", "cpu_seconds"})
    for (const double gap : gaps) columns.push_back(fmt::format("{}@{:g}", kind, gap));
  for (const char* name :
       {"factorisations", "sweeps_done", "sweeps_rising", "least_gap", "least_sweep", "failure"})
    columns.emplace_back(name);
  files::CsvWriter out(path, columns);
  for (const solvers::SolverRun& solver_run : all.runs) {
    out.cell(solver_run.name);
    for (const auto& reached : solver_run.reached) reached ? out.cell(reached->sweeps) : out.cell("");
    for (const auto& reached : solver_run.reached) reached ? out.cell(reached->seconds) : out.cell("");
    out.cell(solver_run.factorisations).cell(solver_run.sweeps).cell(solver_run.rises);
    out.cell(solver_run.least_gap).cell(solver_run.least_sweep).cell(solver_run.failure).end_row();
  }
  out.commit();
}

// A gap below the last that counts is drawn a decade below it: exact answers have no place on a logarithm.
std::string chart_of(const solvers::SolverRuns& all, const std::vector<double>& gaps,
                     const std::string& title, const std::string& command) {
  pictures::Chart chart;
  chart.title = title, chart.curves = true;
  chart.x_label = "sweeps or iterations", chart.y_label = "energy left above the answer, of the start's";
  for (const solvers::SolverRun& solver_run : all.runs) {
    pictures::ChartSeries series{solver_run.name, {{}}};
    for (const solvers::Sample& sample : solver_run.samples) {
      const double gap = std::max(sample.gap, gaps.back() / 10);
      series.ladders[0].push_back(
          {static_cast<double>(sample.sweep), gap, false,
           fmt::format("{}, sweep {}\ngap {:.3g}", solver_run.name, sample.sweep, sample.gap), command});
    }
    chart.series.push_back(std::move(series));
  }
  return pictures::svg_of(chart);
}

/// Up to and with the step; none where it was reached, else how the program ends.
std::optional<int> walk(levels::ReferenceMover& motion, std::uint64_t step, levels::StepState& before) {
  run::Progress progress(step + 1);
  run::RunResult result = run::simulate(motion, step, {&progress}, levels::stop_requested);
  before = motion.state();
  result = run::simulate(motion, step + 1, {&progress}, levels::stop_requested, std::move(result));
  if (result.outcome == run::Outcome::interrupted) return interrupted;
  if (result.rows.size() > step) return std::nullopt;
  fmt::print("{}\n", result.sentence);
  return differs;
}

std::string words_of(const SolversOptions& o) {
  std::string words = fmt::format("{} --step {}", words_of(o.common), o.step);
  if (o.start.cold) words += " --cold";
  if (o.start.still) words += " --still";
  if (o.start.time_step > 0) words += fmt::format(" --time-step {}", o.start.time_step);
  return words;
}

void write_files(const SolversOptions& o, const solvers::SolverRuns& all, const std::string& title) {
  const std::filesystem::path folder = o.out;
  write_csv(all, o.gaps, folder / "solvers.csv");
  files::write_file(folder / "solvers.svg", chart_of(all, o.gaps, title + ": ways to its network's answer",
                                                     "hopmesh solvers " + words_of(o)));
  fmt::print("Results\n  {}\n  {}\n", (folder / "solvers.csv").string(), (folder / "solvers.svg").string());
}

/// The rivals, and the array before them.
int race_all(const SolversOptions& o, const levels::Prepared& p, const solvers::Problem& whole) {
  const solvers::Problem problem = solvers::reached(whole);
  const solvers::Limits limits{o.gaps, static_cast<std::uint64_t>(o.max_sweeps)};
  const std::string title = fmt::format("{} step {}", p.inputs.scene.name, o.step);
  solvers::SolverRuns all = solvers::solve_with_all(problem, limits, levels::stop_requested);
  if (levels::stop_requested) return interrupted;
  if (all.runs.empty()) {
    fmt::print("{}: the network starts at its rest; there is nothing to solve\n", title);
    return differs;
  }
  networks::StepArray array(whole, p);
  all.runs.insert(all.runs.begin(),
                  networks::run_array(array, problem, all.answer, limits, levels::stop_requested));
  if (levels::stop_requested) return interrupted;
  fmt::print("{}: {} outputs, {} weights; {}\n", title, problem.I.size(), problem.W.nonZeros(),
             all.answer.convex ? "convex, gaps to the exact answer"
                               : "not convex, gaps to the lowest energy found");
  fmt::print(
      "sweeps, then processor milliseconds (shared cores: a guide), until the energy's gap is that part "
      "of the start's\n");
  print_table(all, o.gaps);
  fmt::print("{}", networks::stall_text(array, all.runs.front(), problem, all.answer));
  if (!o.out.empty()) write_files(o, all, title);
  return done;
}

int solvers(SolversOptions& o) {
  std::sort(o.gaps.rbegin(), o.gaps.rend());
  if (const auto twice = std::adjacent_find(o.gaps.begin(), o.gaps.end()); twice != o.gaps.end())
    throw input::input_error("", 0, "--gap", fmt::format("{:g} twice", *twice), "each gap once");
  const levels::Prepared p = prepare(o.common);
  if (o.step >= p.inputs.scene.motion.steps)
    throw input::input_error("", 0, "--step", std::to_string(o.step),
                             fmt::format("0 to {} (the scene's steps)", p.inputs.scene.motion.steps - 1));
  if (!o.out.empty()) files::check_writable(o.out, 1 << 20);
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  levels::catch_interrupts();
  levels::StepState before;
  if (const auto ended = walk(motion, static_cast<std::uint64_t>(o.step), before)) return *ended;
  try {
    return race_all(o, p, networks::step_problem(motion, before, p, o.start));
  } catch (const levels::Stopped&) {
    return interrupted;
  }
}

} // namespace

void add_solvers(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<SolversOptions>();
  CLI::App* verb =
      program.add_subcommand("solvers", "other solvers of one step's network, beside its own rule");
  add_common(*verb, o->common);
  verb->add_option("--step", o->step, "the step, counted from 0")->required()->check(whole_number(0));
  verb->add_option("--gap", o->gaps, "parts of the start's energy gap to be reached (1e-2,1e-4,1e-6)")
      ->delimiter(',')
      ->check(share());
  verb->add_option("--max-sweeps", o->max_sweeps, "where a method gives up (20000)")->check(whole_number(1));
  auto* cold = verb->add_flag("--cold", o->start.cold, "start from zero, not from the step before");
  auto* still = verb->add_flag("--still", o->start.still,
                               "start from where the mesh stands, and expand the energy there (incremental)");
  still->excludes(cold);
  verb->add_option("--time-step", o->start.time_step, "of the step asked about, if not the motion's; s")
      ->check(positive_number())
      ->needs(still);
  verb->add_option("--out", o->out, "folder for solvers.csv and solvers.svg");
  verb->footer("Example:\n  hopmesh solvers banner --step 10 --out out/solvers");
  verb->callback([o, &exit_code] { exit_code = solvers(*o); });
}

} // namespace hopmesh::cli
