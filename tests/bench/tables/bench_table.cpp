// Reads what the benchmarks wrote and prints what it means: figures, then requirement | measured | met?
// With a fourth argument it draws the speeds as well. Exit code 1 where levels gave different bits or cycles,
// or a benchmark failed; never for a time.
#include "tests/bench/tables/bench_results.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

namespace {

using hopmesh::bench::Results;

const std::string by_phase = "by phase", by_clock = "by clock", sc_fixed = "sc_fixed, a signal per value";

std::string short_number(double x) {
  if (x >= 1e6) return fmt::format("{:.3g} M", x / 1e6);
  if (x >= 1e3) return fmt::format("{:.3g} k", x / 1e3);
  return fmt::format("{:.3g}", x);
}

/// What bench_array and bench_rtl call their models: array/model.
const std::string in_systemc = "flag-400", in_verilog = "flag-400 rtl";

double updates_of(const Results& r, const std::string& model, const std::string& array = in_systemc) {
  return r.median(array + "/" + model, "updates/s");
}

/// Fastest first; the file has them in the order of their random turns.
std::vector<std::string> models(const Results& r, const std::string& array = in_systemc) {
  auto names = r.names(array);
  std::sort(names.begin(), names.end(),
            [&](const auto& a, const auto& b) { return updates_of(r, a, array) > updates_of(r, b, array); });
  return names;
}

// ---- tables of figures

void print_speeds(const Results& r, const std::string& array) {
  fmt::print("  {:<32}{:>14}{:>14}{:>11}{:>10}\n", "model", "updates/s", "cycles/s", "ns/cycle", "spread");
  for (const auto& name : models(r, array)) {
    const auto updates = r.samples(array + "/" + name, "updates/s");
    const double cycles = r.median(array + "/" + name, "cycles/s");
    fmt::print("  {:<32}{:>14}{:>14}{:>11.1f}{:>8.0f} %\n", name, short_number(updates.median()),
               short_number(cycles), 1e9 / cycles,
               100 * (updates.largest() - updates.least()) / updates.median());
  }
}

void print_all_speeds(const Results& r) {
  fmt::print("\nThe array of flag-400 (380 cells, 1,140 neurons, 12 phases), one process, turns at random\n");
  print_speeds(r, in_systemc);
  fmt::print("\nThe same array in Verilog, in a process of its own\n");
  print_speeds(r, in_verilog);
}

/// Processor seconds of 400 steps: parts measured inside, the rest by difference of whole processes.
void print_parts(const Results& r) {
  const double checked = r.median("run flag-400/checked", "processor_s"),
               bare = r.median("run flag-400/no check", "processor_s");
  const std::vector<std::pair<std::string, std::string>> parts{
      {"array (SystemC)", "array_s"},
      {"bus and windows", "bus_s"},
      {"driver: to codes and back", "driver_s"},
      {"firmware: network, motion", "network_and_motion_s"}};
  double known = 0;
  fmt::print("\nhopmesh run flag-400, 400 steps, no waves\n");
  fmt::print("  {:<34}{:>8.2f} s wall, {:.2f} s of processor\n", "checked against the reference",
             r.median("run flag-400/checked", "real_time") / 1e3, checked);
  fmt::print("  {:<34}{:>8.2f} s wall, {:.2f} s of processor, of which\n", "--no-check",
             r.median("run flag-400/no check", "real_time") / 1e3, bare);
  for (const auto& [label, counter] : parts) {
    const double s = r.median("flag-400 steps/parts", counter);
    known += s;
    fmt::print("    {:<32}{:>8.3f} s {:>5.1f} %\n", label, s, 100 * s / bare);
  }
  fmt::print("    {:<32}{:>8.3f} s {:>5.1f} %\n", "start, measures, files, report", bare - known,
             100 * (bare - known) / bare);
  fmt::print("  {:<34}{:>8.2f} s of processor more\n", "the reference check", checked - bare);
}

/// What is not the array: a step by parts, and what comes once a run.
void print_host(const Results& r) {
  fmt::print("\nThe host beside an array that costs nothing\n  "
             "{:>9}{:>11}{:>10}{:>8}{:>10}{:>10}{:>10}{:>11}{:>11}{:>11}{:>9}\n",
             "nodes", "network", "load", "back", "motion", "measures", "record", "us/step", "mesh", "finish",
             "peak");
  for (const auto& name : r.names("host")) {
    const auto at = [&](const char* counter) { return r.median("host/" + name, counter); };
    double step = 0;
    fmt::print("  {:>9}", name);
    const std::vector<std::pair<const char*, int>> parts{{"network_us", 11},  {"load_us", 10},
                                                         {"read_back_us", 8}, {"motion_us", 10},
                                                         {"measures_us", 10}, {"record_us", 10}};
    for (const auto& [part, width] : parts) {
      fmt::print("{:>{}.1f}", at(part), width);
      step += at(part);
    }
    fmt::print("{:>11.1f}{:>8.1f} ms{:>8.0f} ms{:>6.0f} MB\n", step, at("mesh_ms"), at("finish_ms"),
               at("peak_mb"));
  }
}

/// Least squares of MB over nodes.
struct Line {
  double base = 0, slope = 0, largest_residual = 0;
};

Line fit(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
  Line line;
  line.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  line.base = (sy - line.slope * sx) / n;
  for (std::size_t k = 0; k < x.size(); ++k)
    line.largest_residual = std::max(line.largest_residual, std::fabs(line.base + line.slope * x[k] - y[k]));
  return line;
}

Line print_memory(const Results& r, double& largest) {
  std::vector<double> nodes, mb;
  fmt::print("\nPeak memory of hopmesh run on square grids\n  {:>8}{:>10}{:>20}\n", "nodes", "MB",
             "MB per 1,000 nodes");
  for (const auto& name : r.names("memory")) {
    nodes.push_back(std::stod(name));
    mb.push_back(r.median("memory/" + name, "peak_mb"));
    fmt::print("  {:>8}{:>10.1f}{:>20.1f}\n", name, mb.back(), 1000 * mb.back() / nodes.back());
  }
  const Line line = fit(nodes, mb);
  largest = mb.back();
  fmt::print("  fit: {:.1f} MB + {:.1f} MB per 1,000 nodes, largest residual {:.1f} MB\n", line.base,
             1000 * line.slope, line.largest_residual);
  return line;
}

// ---- requirements

void requirement(const std::string& what, const std::string& measured, bool met) {
  fmt::print("  {:<62} | {:<28} | {}\n", what, measured, met ? "yes" : "NO");
}

/// Median over median, and what the extremes of all turns would make of it.
void ratio(const Results& r, const std::string& what, const std::string& slow, double wanted) {
  const auto fast = r.samples("flag-400/" + by_phase, "updates/s"),
             other = r.samples("flag-400/" + slow, "updates/s");
  const double x = fast.median() / other.median();
  requirement(what,
              fmt::format("{:.0f}x ({:.0f}x to {:.0f}x)", x, fast.least() / other.largest(),
                          fast.largest() / other.least()),
              x >= wanted);
}

void print_requirements(const Results& r, const Line& line, double largest_mb) {
  fmt::print("\n  {:<62} | {:<28} | {}\n", "requirement", "measured", "met?");
  fmt::print("  {:-<62}-|-{:-<28}-|-----\n", "", "");
  ratio(r, "waking by phase at least 20x faster than by clock", by_clock, 20);
  ratio(r, "at least 100x sc_fixed and a signal per value", sc_fixed, 100);
  const double folded = updates_of(r, by_phase + ", folded");
  requirement("by phase on 16 elements, one stage: at least 10 M updates/s", short_number(folded),
              folded >= 1e7);
  requirement("the same codes, sweeps and cycles from all of them",
              r.errors().empty() ? "equal" : r.errors().front(), r.errors().empty());
  const double mb = r.samples("run flag-400/checked", "peak_mb").largest();
  requirement("flag-400, 400 steps, in under 300 MB", fmt::format("{:.0f} MB", mb), mb < 300);
  const double residual = 100 * line.largest_residual / largest_mb;
  requirement("memory linear in nodes: residual under 5 % of the largest", fmt::format("{:.1f} %", residual),
              residual < 5);
  const double cycles = r.median("run flag-400/checked", "cycles"),
               parts = r.median("flag-400 steps/parts", "cycles");
  requirement("400 timed steps are those of the program: same cycles",
              fmt::format("{:.0f}, {:.0f}", cycles, parts), cycles == parts);
}

// ---- picture

/// A bar a model, updates/s on a logarithmic axis, as SVG.
std::string picture(const Results& r) {
  constexpr double left = 190, width = 440, row = 34, top = 44, first_decade = 4;
  const auto names = models(r);
  const double decades = std::ceil(std::log10(std::max(1e8, updates_of(r, names.front())))) - first_decade;
  const double bottom = top + row * static_cast<double>(names.size());
  const auto at = [&](double x) { return left + width * (std::log10(x) - first_decade) / decades; };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"720\" height=\"{0:.0f}\" viewBox=\"0 0 720 "
      "{0:.0f}\" "
      "role=\"img\" font-family=\"sans-serif\" font-size=\"13\">\n<title>Neuron updates per second by model, "
      "logarithmic</title>\n<rect width=\"720\" height=\"{0:.0f}\" rx=\"6\" fill=\"#ffffff\"/>\n"
      "<text x=\"{1}\" y=\"22\" font-weight=\"bold\" fill=\"#222222\">Neuron updates per second, flag-400 "
      "(logarithmic)</text>\n",
      bottom + 34, left);
  for (int k = 0; k <= static_cast<int>(decades); ++k) {
    const double x = at(std::pow(10, first_decade + k));
    svg +=
        fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#cccccc\"/>\n"
                    "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\" fill=\"#666666\">{4}</text>\n",
                    x, top - 8, bottom, bottom + 18, short_number(std::pow(10, first_decade + k)));
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double updates = updates_of(r, names[k]), y = top + row * static_cast<double>(k);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#222222\">{}</text>\n"
                       "<rect x=\"{}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"18\" rx=\"2\" fill=\"{}\"/>\n"
                       "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#222222\">{}</text>\n",
                       left - 8, y + 14, names[k], left, y, at(updates) - left,
                       names[k] == sc_fixed ? "#999999" : "#1f5fa8", at(updates) + 6, y + 14,
                       short_number(updates));
  }
  return svg + "</svg>\n";
}

void print_all(const Results& r, const std::string& picture_file) {
  print_all_speeds(r);
  print_parts(r);
  print_host(r);
  double largest_mb = 0;
  const Line line = print_memory(r, largest_mb);
  print_requirements(r, line, largest_mb);
  if (!picture_file.empty()) std::ofstream(picture_file) << picture(r);
}

} // namespace

int main(int argc, char** argv) {
  return print_tables(argc, argv, 4, "bench_table ARRAY.json RTL.json PROGRAM.json HOST.json [PICTURE.svg]",
                      print_all);
}
