// A race of solvers as solvers.csv and solvers.svg.
#include "sim/files/csv.h"
#include "sim/networks/solved_step.h"
#include "sim/pictures/svg_chart.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

void write_table(const std::filesystem::path& path, const solvers::SolverRuns& all,
                 const std::vector<double>& gaps) {
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
pictures::ChartSeries series_of(const solvers::SolverRun& solver_run, double last_gap,
                                const std::string& command) {
  pictures::ChartSeries series{solver_run.name, {{}}};
  for (const solvers::Sample& sample : solver_run.samples)
    series.ladders[0].push_back(
        {static_cast<double>(sample.sweep), std::max(sample.gap, last_gap / 10), false,
         fmt::format("{}, sweep {}\ngap {:.3g}", solver_run.name, sample.sweep, sample.gap), command});
  return series;
}

} // namespace

void check_solver_files(const std::filesystem::path& folder) {
  files::check_writable(folder, 1 << 20);
}

void write_solver_files(const std::filesystem::path& folder, const SolvedStep& solved,
                        const std::vector<double>& gaps, const std::string& command) {
  pictures::Chart chart;
  chart.title = solved.title + ": ways to its network's answer", chart.curves = true;
  chart.x_label = "sweeps or iterations", chart.y_label = "energy left above the answer, of the start's";
  for (const solvers::SolverRun& solver_run : solved.all.runs)
    chart.series.push_back(series_of(solver_run, gaps.back(), command));
  write_table(folder / "solvers.csv", solved.all, gaps);
  files::write_file(folder / "solvers.svg", pictures::svg_of(chart));
}

} // namespace hopmesh::networks
