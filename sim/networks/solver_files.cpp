// All solvers beside each other, as solvers.csv and solvers.svg.
#include "sim/files/csv.h"
#include "sim/networks/solved_step.h"
#include "sim/pictures/svg_chart.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

/// A cell a gap, empty where it was not reached, or by no hardware.
template <typename Figure>
void write_hardware(files::CsvWriter& out, const solvers::SolverRun& solver_run, Figure figure) {
  for (const auto& reached : solver_run.reached)
    reached && reached->hardware ? out.cell((*reached->hardware).*figure) : out.cell("");
}

/// Of an array stopped by the scene's rule.
void write_certainty(files::CsvWriter& out, const SolvedStep& solved, const std::string& name) {
  const auto found = solved.certain.find(name);
  const bool known = found != solved.certain.end();
  known ? out.cell(found->second.measured) : out.cell("");
  out.cell(known ? found->second.told : std::nullopt);
  known ? out.cell(found->second.held) : out.cell("");
  const auto bound = known ? found->second.bound : std::nullopt;
  out.cell(bound ? std::optional(bound->least()) : std::nullopt);
}

void write_table(const std::filesystem::path& path, const SolvedStep& solved,
                 const std::vector<double>& gaps) {
  std::vector<std::string> columns{"method"};
  for (const char* kind : {"sweeps", "cpu_seconds", "hardware_seconds", "array_cycles", "multiplies"})
    for (const double gap : gaps) columns.push_back(fmt::format("{}@{:g}", kind, gap));
  for (const char* name : {"factorisations", "sweeps_done", "sweeps_rising", "least_gap", "least_sweep",
                           "output_error", "told_error", "held", "error_bound", "failure"})
    columns.emplace_back(name);
  files::CsvWriter out(path, columns);
  for (const solvers::SolverRun& solver_run : solved.all.runs) {
    out.cell(solver_run.name);
    for (const auto& reached : solver_run.reached) reached ? out.cell(reached->sweeps) : out.cell("");
    for (const auto& reached : solver_run.reached) reached ? out.cell(reached->seconds) : out.cell("");
    write_hardware(out, solver_run, &solvers::HardwareWork::seconds);
    write_hardware(out, solver_run, &solvers::HardwareWork::array_cycles);
    write_hardware(out, solver_run, &solvers::HardwareWork::multiplies);
    out.cell(solver_run.factorisations).cell(solver_run.sweeps).cell(solver_run.rises);
    out.cell(solver_run.least_gap).cell(solver_run.least_sweep);
    write_certainty(out, solved, solver_run.name);
    out.cell(solver_run.failure).end_row();
  }
  out.commit();
}

/// What a run had done by a sample; 0: nothing to draw.
using Work = double (*)(const solvers::Sample& sample);

// A gap below the last that counts is drawn a decade below it: exact answers have no place on a logarithm.
pictures::ChartSeries series_of(const solvers::SolverRun& solver_run, double last_gap, Work work,
                                const std::string& command) {
  pictures::ChartSeries series{solver_run.name, {{}}};
  for (const solvers::Sample& sample : solver_run.samples)
    if (const double x = work(sample); x > 0)
      series.ladders[0].push_back(
          {x, std::max(sample.gap, last_gap / 10), false,
           fmt::format("{}, sweep {}\ngap {:.3g}", solver_run.name, sample.sweep, sample.gap), command});
  return series;
}

/// A way to look at the same runs: against sweeps, against seconds, against multiplications.
struct View {
  const char *file, *label;
  Work work;
};

const View views[] = {
    {"solvers.svg", "sweeps or iterations",
     [](const solvers::Sample& sample) { return static_cast<double>(sample.sweep); }},
    {"seconds.svg", "s: of an array's clock with its bus, of a processor for the others",
     [](const solvers::Sample& sample) {
       return sample.hardware ? sample.hardware->seconds : sample.seconds;
     }},
    {"multiplies.svg", "multiplications of an array",
     [](const solvers::Sample& sample) {
       return sample.hardware ? static_cast<double>(sample.hardware->multiplies) : 0;
     }},
};

} // namespace

void check_solver_files(const std::filesystem::path& folder) {
  files::check_writable(folder, 1 << 20);
}

void write_solver_files(const std::filesystem::path& folder, const SolvedStep& solved,
                        const std::vector<double>& gaps, const std::string& command) {
  write_table(folder / "solvers.csv", solved, gaps);
  for (const View& view : views) {
    pictures::Chart chart;
    chart.title = solved.title + ": ways to its network's answer", chart.curves = true;
    chart.x_label = view.label, chart.y_label = "energy left above the answer, of the start's";
    for (const solvers::SolverRun& solver_run : solved.all.runs)
      if (auto series = series_of(solver_run, gaps.back(), view.work, command); !series.ladders[0].empty())
        chart.series.push_back(std::move(series));
    files::write_file(folder / view.file, pictures::svg_of(chart));
  }
}

} // namespace hopmesh::networks
