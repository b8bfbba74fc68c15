#include "sim/study/compare.h"

#include "sim/study/array_info.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

Distance distance(std::uint64_t steps, const std::vector<double>& a, const std::vector<double>& b) {
  Distance d;
  d.steps = steps;
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); k += 3) {
    const double square =
        std::pow(a[k] - b[k], 2) + std::pow(a[k + 1] - b[k + 1], 2) + std::pow(a[k + 2] - b[k + 2], 2);
    sum += square;
    d.largest = std::max(d.largest, std::sqrt(square));
  }
  d.rms = std::sqrt(sum / (static_cast<double>(a.size()) / 3));
  return d;
}

void note(LevelReport& report, const StepRow& row) {
  report.sweeps += row.sweeps;
  report.cycles += row.cycles;
  if (!row.error) return;
  report.largest_output_error = std::max(report.largest_output_error, row.error->largest_output);
  report.rms_output_error = std::max(report.rms_output_error, row.error->rms_output);
  report.largest_energy_gap = std::max(report.largest_energy_gap, row.error->energy_gap);
  report.largest_network_error = std::max(report.largest_network_error, row.error->network);
}

// Two fixed levels after the same step; explained by running its network again on both.
std::optional<Difference> difference(const Contender& a, const StepRow& row_a, const Contender& b,
                                     const StepRow& row_b, const BuiltMesh& mesh,
                                     const spec::ArraySpec& array) {
  const bool same_codes = a.array->rest_raw() == b.array->rest_raw();
  if (same_codes && row_a.sweeps == row_b.sweeps && row_a.cycles == row_b.cycles) return std::nullopt;
  Difference d{
      {a.level, b.level}, row_a.step, {row_a.sweeps, row_b.sweeps}, {row_a.cycles, row_b.cycles}, {}};
  const LoadedNetwork network = loaded_network(a.port->bus(), mesh.topology(), a.array->start_raw());
  d.where = first_difference(a.port->bus(), b.port->bus(), mesh, array, network);
  return d;
}

bool is_mark(std::uint64_t step, std::uint64_t steps) {
  return step == 1 || step == 10 || step == 100 || step == 1000 || step == steps;
}

} // namespace

namespace {

// One step of every contender, or how and why there was none.
std::vector<StepRow> advance_all(std::vector<Contender>& contenders, Comparison& result) {
  std::vector<StepRow> rows;
  try {
    for (Contender& c : contenders) rows.push_back(c.motion->advance());
    result.steps += 1;
    return rows;
  } catch (const Diverged& why) {
    result.outcome = Outcome::diverged;
    result.sentence =
        fmt::format("{} diverged in step {}: {}.", contenders[rows.size()].level, result.steps, why.what());
  } catch (const Stopped&) {
    result.outcome = Outcome::interrupted;
  }
  return {};
}

void note_rows(const std::vector<Contender>& contenders, const std::vector<StepRow>& rows,
               Comparison& result) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    note(result.levels[k], rows[k]);
    if (rows[k].max_stretch < most_stretch) continue;
    result.outcome = Outcome::diverged;
    result.sentence = fmt::format("{} diverged in step {}: a spring is {:.3g} times its length.",
                                  contenders[k].level, rows[k].step, rows[k].max_stretch);
  }
}

// Every fixed level against the first of them.
void compare_codes(const std::vector<Contender>& contenders, const std::vector<StepRow>& rows,
                   const BuiltMesh& mesh, const spec::ArraySpec& array, Comparison& result) {
  std::size_t first = 0;
  while (first < contenders.size() && !contenders[first].array) ++first;
  result.pairs = 0;
  for (std::size_t k = first + 1; k < contenders.size() && !result.difference; ++k) {
    if (!contenders[k].array) continue;
    result.difference = difference(contenders[first], rows[first], contenders[k], rows[k], mesh, array);
    result.pairs += 1;
  }
}

// The reference, where it takes part, comes first.
void note_distances(const std::vector<Contender>& contenders, Comparison& result) {
  if (contenders[0].array) return;
  for (std::size_t k = 1; k < contenders.size(); ++k)
    result.levels[k].distances.push_back(
        distance(result.steps, contenders[0].motion->positions(), contenders[k].motion->positions()));
}

} // namespace

Comparison compare(std::vector<Contender>& contenders, const BuiltMesh& mesh, const spec::ArraySpec& array,
                   std::uint64_t steps, const std::function<void(const StepRow&)>& after_step,
                   const std::atomic<bool>& stop) {
  Comparison result;
  for (const Contender& c : contenders) result.levels.push_back({c.level, 0, 0, 0, 0, {}, 0, 0});
  while (result.steps < steps && !result.difference && result.outcome == Outcome::finished) {
    if (stop) {
      result.outcome = Outcome::interrupted;
      break;
    }
    const std::vector<StepRow> rows = advance_all(contenders, result);
    if (rows.empty()) break;
    note_rows(contenders, rows, result);
    compare_codes(contenders, rows, mesh, array, result);
    if (is_mark(result.steps, steps) || result.outcome != Outcome::finished)
      note_distances(contenders, result);
    after_step(rows.back());
  }
  if (result.outcome == Outcome::interrupted)
    result.sentence = fmt::format("Interrupted after {} of {} steps.", result.steps, steps);
  if (result.sentence.empty())
    result.sentence = result.difference ? "Stopped at the first difference." : "All steps done.";
  return result;
}

namespace {

std::string text_of(const FirstDifference& w, const Difference& d) {
  std::string text = fmt::format(
      "  sweep {}, cycle {} of the run, node {}, neuron {}: V {} -> {} ({}) or {} ({})\n", w.sweep, w.cycle,
      w.node, w.component, w.before_raw, w.raw[0], d.level[0], w.raw[1], d.level[1]);
  text += fmt::format("  its inputs one update earlier, bias {}:\n", w.bias_raw);
  for (const NeuronInput& in : w.inputs)
    text += fmt::format("    node {:>6} neuron {}  weight {:>11}  V {:>11}\n", in.node, in.component,
                        in.weight_raw, in.output_raw);
  return text;
}

std::string text_of(const Difference& d, const std::string& scene) {
  std::string text =
      fmt::format("{} and {} differ first in step {}: {} sweeps and {} cycles against {} and {}\n",
                  d.level[0], d.level[1], d.step, d.sweeps[0], d.cycles[0], d.sweeps[1], d.cycles[1]);
  if (d.where)
    text += text_of(*d.where, d);
  else
    text += "  run again from the same start, every output is the same after every sweep: the fault does not "
            "repeat\n";
  return text + fmt::format("  a wave of that step: hopmesh run {} --level systemc --steps {} --wave "
                            "step.vcd --wave-window {}:{}\n",
                            scene, d.step + 1, d.step, d.step + 1);
}

std::string text_of(const LevelReport& r) {
  std::string text = fmt::format("{}: {} sweeps", r.level, grouped(r.sweeps));
  if (r.cycles > 0) text += fmt::format(", {} cycles", grouped(r.cycles)); // the reference has none
  text += "\n";
  if (r.distances.empty()) return text;
  text +=
      fmt::format("  each step against the reference's answer to the same step:\n"
                  "    outputs differ by at most {:.3g}, worst rms of a step {:.3g}\n"
                  "    energy left above the reference's rest: at most {:.3g} of the step's fall\n"
                  "    weights and biases differ by at most {:.2g} of the largest\n"
                  "  the free motions part (positions, m):\n",
                  r.largest_output_error, r.rms_output_error, r.largest_energy_gap, r.largest_network_error);
  for (const Distance& d : r.distances)
    text += fmt::format("    after {:>5} steps  rms {:.3g}  largest {:.3g}\n", d.steps, d.rms, d.largest);
  return text;
}

} // namespace

std::string text_of(const Comparison& c, const std::string& scene, const spec::ArraySpec& array) {
  std::string text = fmt::format("{} on array {}, {} steps. {}\n", scene, array.name, c.steps, c.sentence);
  for (const LevelReport& report : c.levels) text += text_of(report);
  if (c.difference) return text + text_of(*c.difference, scene);
  if (c.pairs > 0) text += "Fixed levels: every code, sweep count and cycle count of every step is equal.\n";
  return text;
}

} // namespace hopmesh::study
