#include "sim/cosim/compare.h"

#include "sim/cosim/undecided.h"
#include "sim/input/count_text.h"
#include "sim/run/unrest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cosim {

using levels::ReadyLevel;

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

std::uint64_t sum_of(const LevelReport& report, std::uint64_t levels::StepRow::*figure) {
  return run::count_of(report.rows, figure, levels::Summary::sum);
}

bool is_mark(std::uint64_t step, std::uint64_t steps) {
  return step == 1 || step == 10 || step == 100 || step == 1000 || step == steps;
}

} // namespace

namespace {

// A step of every level, or how and why there was none.
std::vector<levels::StepRow> advance_all(const std::vector<ReadyLevel>& ready, Comparison& result) {
  std::vector<levels::StepRow> rows;
  try {
    for (const ReadyLevel& c : ready) rows.push_back(c.mover->advance());
    result.steps += 1;
    return rows;
  } catch (const levels::LostMotion& why) {
    result.outcome = run::Outcome::diverged;
    result.sentence =
        fmt::format("{} diverged in step {}: {}.", ready[rows.size()].level->name, result.steps, why.what());
  } catch (const levels::Stopped&) {
    result.outcome = run::Outcome::interrupted;
  }
  return {};
}

void note_rows(const std::vector<ReadyLevel>& ready, const std::vector<levels::StepRow>& rows,
               Comparison& result) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    result.levels[k].rows.push_back(rows[k]);
    if (rows[k].max_stretch < run::most_stretch) continue;
    result.outcome = run::Outcome::diverged;
    result.sentence = fmt::format("{} diverged in step {}: a spring is {:.3g} times its length.",
                                  ready[k].level->name, rows[k].step, rows[k].max_stretch);
  }
}

Difference difference(const ReadyLevel& a, const levels::StepRow& row_a, const ReadyLevel& b,
                      const levels::StepRow& row_b) {
  Difference d;
  d.level[0] = a.level->name, d.level[1] = b.level->name;
  if (const ReadyLevel* waving = b.level->can_wave ? &b : a.level->can_wave ? &a : nullptr)
    d.waving = waving->level->name;
  d.step = row_a.step;
  d.sweeps[0] = row_a.sweeps, d.sweeps[1] = row_b.sweeps;
  d.cycles[0] = row_a.cycles, d.cycles[1] = row_b.cycles;
  return d;
}

// All fixed levels of a comparison after one step: the first of them, and the others held against it.
class Round {
 public:
  Round(const std::vector<ReadyLevel>& ready, const std::vector<levels::StepRow>& rows,
        const levels::BuiltMesh& mesh, const spec::ArraySpec& array)
      : ready_(ready), rows_(rows), mesh_(mesh) {
    for (std::size_t k = 0; k < ready.size(); ++k)
      if (ready[k].array) fixed_.push_back(k), arrays_.emplace_back(ready[k].port->bus(), mesh.topology());
    if (fixed_.size() < 2) return;
    run_ = arrays_[0].last_run();
    job_ = loaded_job(of(0).port->bus(), array, mesh.topology(), of(0).array->start_raw());
  }

  std::size_t pairs() const { return fixed_.empty() ? 0 : fixed_.size() - 1; }
  std::uint32_t sweeps() const { return run_.sweeps; }

  /// Nothing if every level gave the same answer, and gives it again sweep by sweep.
  std::optional<Difference> judge() {
    for (std::size_t k = 1; k < fixed_.size(); ++k)
      if (auto d = difference_of_answers(k)) return d;
    if (pairs() == 0) return std::nullopt;
    const Lockstep l = run_in_lockstep(arrays_, job_, run_.sweeps);
    if (!l.where && l.outputs[0] == of(0).array->rest_raw()) return std::nullopt;
    Difference d = between(l.where ? l.other : 0);
    if (!l.where) d.level[1] += " sweep by sweep";
    if (l.where) d.where = in_mesh(*l.where, mesh_, job_);
    return d;
  }

 private:
  const ReadyLevel& of(std::size_t k) const { return ready_[fixed_[k]]; }
  Difference between(std::size_t k) const {
    Difference d = difference(of(0), rows_[fixed_[0]], of(k), rows_[fixed_[k]]);
    d.cycles_before = rows_[fixed_[0]].cycles - run_.cycles;
    return d;
  }

  // What the levels said of themselves, and what they have loaded; explained by running the network again.
  std::optional<Difference> difference_of_answers(std::size_t k) const {
    const levels::StepRow &a = rows_[fixed_[0]], &b = rows_[fixed_[k]];
    const bool same_codes = of(0).array->rest_raw() == of(k).array->rest_raw();
    const Arrays two{arrays_[0], arrays_[k]};
    const std::string memory = memory_difference(two, job_);
    if (same_codes && a.sweeps == b.sweeps && a.cycles == b.cycles && memory.empty()) return std::nullopt;
    Difference d = between(k);
    d.memory = memory;
    d.where = first_difference(two, mesh_, job_, job_.max_sweeps);
    return d;
  }

  const std::vector<ReadyLevel>& ready_;
  const std::vector<levels::StepRow>& rows_;
  const levels::BuiltMesh& mesh_;
  std::vector<std::size_t> fixed_;
  Arrays arrays_;
  ArrayJob job_;
  spec::Relaxation run_; ///< of the first fixed level
};

// Every fixed level against the first of them.
void compare_codes(const std::vector<ReadyLevel>& ready, const std::vector<levels::StepRow>& rows,
                   const levels::BuiltMesh& mesh, const spec::ArraySpec& array, Comparison& result) {
  try {
    Round round(ready, rows, mesh, array);
    result.pairs = round.pairs();
    result.difference = round.judge();
    if (!result.difference) result.sweeps_compared += round.sweeps();
  } catch (const levels::Stopped&) {
    result.outcome = run::Outcome::interrupted;
  }
  if (!result.difference) return;
  // The levels' totals have this step in them already.
  for (const LevelReport& report : result.levels)
    if (report.level == result.difference->level[0])
      result.difference->cycles_before +=
          sum_of(report, &levels::StepRow::cycles) - result.difference->cycles[0];
}

// The reference, where it takes part, comes first.
void note_distances(const std::vector<ReadyLevel>& ready, Comparison& result) {
  if (ready[0].level->kind != levels::Kind::reference) return;
  for (std::size_t k = 1; k < ready.size(); ++k)
    result.levels[k].distances.push_back(
        distance(result.steps, ready[0].mover->positions(), ready[k].mover->positions()));
}

} // namespace

Comparison compare(const std::vector<ReadyLevel>& ready, const levels::BuiltMesh& mesh,
                   const spec::ArraySpec& array, std::uint64_t steps,
                   const std::function<void(const levels::StepRow&)>& after_step,
                   const std::atomic<bool>& stop) {
  Comparison result;
  for (const ReadyLevel& c : ready) result.levels.push_back({c.level->name, {}, {}});
  while (result.steps < steps && !result.difference && result.outcome == run::Outcome::finished) {
    if (stop) {
      result.outcome = run::Outcome::interrupted;
      break;
    }
    const std::vector<levels::StepRow> rows = advance_all(ready, result);
    if (rows.empty()) break;
    note_rows(ready, rows, result);
    compare_codes(ready, rows, mesh, array, result);
    if (is_mark(result.steps, steps) || result.outcome != run::Outcome::finished)
      note_distances(ready, result);
    after_step(rows.back());
  }
  if (result.outcome == run::Outcome::interrupted)
    result.sentence = fmt::format("Interrupted after {} of {} steps.", result.steps, steps);
  if (result.sentence.empty())
    result.sentence = result.difference ? "Stopped at the first difference."
                      : steps == 1      ? "The step is done."
                                        : "All steps done.";
  return result;
}

namespace {

// From the sweep before to the sweep behind the difference; the whole step where no cycle is known.
std::string wave_command(const Difference& d, const std::string& inputs) {
  std::string command = fmt::format("hopmesh run {} --level {} --no-check --steps {} --out out/difference "
                                    "--wave difference.vcd --wave-window ",
                                    inputs, d.waving, d.step + 1);
  if (!d.where) return command + fmt::format("{}:{}", d.step, d.step + 1);
  const std::uint64_t at = d.cycles_before + d.where->cycle, around = d.where->sweep_cycles;
  return command +
         fmt::format("{}:{}c --wave-cells {}", at - std::min(at, around), at + around, d.where->cell);
}

std::string text_of(const Difference& d, const std::string& inputs) {
  std::string text =
      fmt::format("{} and {} differ first in step {}: {} sweeps and {} cycles against {} and {}\n",
                  d.level[0], d.level[1], d.step, d.sweeps[0], d.cycles[0], d.sweeps[1], d.cycles[1]);
  if (!d.memory.empty()) text += fmt::format("  their memories differ, {}\n", d.memory);
  if (d.where)
    text += text_of(*d.where, d.level[0], d.level[1]);
  else
    text += "  run again from the same start, every output is the same after every sweep: the fault does not "
            "repeat\n";
  if (!d.waving.empty()) text += fmt::format("  a wave around it: {}\n", wave_command(d, inputs));
  return text;
}

std::string text_of(const LevelReport& r) {
  const auto largest = [&](double levels::ReferenceError::*figure) {
    return run::total_of(r.rows, figure, levels::Summary::largest);
  };
  using Error = levels::ReferenceError;
  const std::uint64_t cycles = sum_of(r, &levels::StepRow::cycles);
  std::string text =
      fmt::format("{}: {}", r.level, input::with_noun(sum_of(r, &levels::StepRow::sweeps), "sweep"));
  if (cycles > 0) text += fmt::format(", {} cycles", input::grouped(cycles)); // the reference has none
  text += "\n";
  if (const std::string unrest = run::unrest_text(r.rows); !unrest.empty()) text += "  " + unrest + "\n";
  if (r.distances.empty()) return text;
  text += fmt::format("  each step against the reference's rest of the same step:\n"
                      "    outputs differ by at most {:.3g}, worst rms of a step {:.3g}\n"
                      "    worst rms by rounding {:.3g}, by where steps stopped {:.3g}\n{}"
                      "    energy left above the reference's rest: at most {:.3g} of the step's fall\n"
                      "    weights and biases differ by at most {:.2g} of the largest\n"
                      "  the free motions part (positions, m):\n",
                      largest(&Error::largest_output), largest(&Error::rms_output), largest(&Error::rounding),
                      largest(&Error::stopping), undecided_text(r.rows), largest(&Error::energy_gap),
                      largest(&Error::network));
  for (const Distance& d : r.distances)
    text += fmt::format("    after {:>5} step{}  rms {:.3g}  largest {:.3g}\n", d.steps,
                        d.steps == 1 ? " " : "s", d.rms, d.largest);
  return text;
}

} // namespace

std::string text_of(const Comparison& c, const std::string& inputs, const spec::ArraySpec& array) {
  const auto end = inputs[0] == '\'' ? inputs.find("' ") : inputs.find(' '); // of the scene's word
  std::string text = fmt::format("{} on array {}, {}. {}\n", inputs.substr(0, end), array.name,
                                 input::with_noun(c.steps, "step"), c.sentence);
  for (const LevelReport& report : c.levels) text += text_of(report);
  if (c.difference) return text + text_of(*c.difference, inputs);
  if (c.pairs > 0)
    text += fmt::format("Fixed levels: equal after each of {} sweeps, every code; sweep and cycle counts of "
                        "every step too.\n",
                        input::grouped(c.sweeps_compared));
  return text;
}

} // namespace hopmesh::cosim
