// hopmesh budget: how much of a run's distance from the truth is whose.
#include "sim/cli/options.h"
#include "sim/files/csv.h"
#include "sim/levels/exact_step.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/levels/reference_mover.h"
#include "sim/pictures/svg_bars.h"
#include "sim/run/progress.h"
#include "sim/run/run_totals.h"
#include "sim/study/error_budget.h"
#include "sim/study/truth_store.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

namespace fs = std::filesystem;

constexpr double at_rest = 1e-14; // of an output in double: nothing moves any more
constexpr std::uint64_t most_times = 10;

struct BudgetOptions {
  CommonOptions common;
  std::string out;
  std::int64_t steps = 0, rest_sweeps = 20'000;
  double time = 0;
};

/// A motion of the chain, and what the next one mends.
struct Link {
  std::string motion, mends;
  std::shared_ptr<levels::Mover> made;
  std::vector<run::Positions> at;
};

struct Budget {
  std::vector<double> times;
  std::vector<Link> chain; ///< the truth, which mends nothing, is its last
  std::vector<double> floor;
  std::vector<std::string> troubles; ///< in sentences
  std::vector<study::BudgetAt> rows; ///< where everybody came to
};

void set_steps(const BudgetOptions& o, levels::Prepared& p) {
  scene::MotionKeys& motion = p.inputs.scene.motion;
  if (o.steps > 0) motion.steps = o.steps;
  if (o.time == 0) return;
  const double steps = std::round(o.time / motion.time_step);
  if (!(steps >= 1 && steps <= 1e9))
    throw input::input_error("", 0, "--time", fmt::format("{}", o.time),
                             fmt::format("from one step of {} s to a billion of them", motion.time_step));
  motion.steps = static_cast<std::int64_t>(steps);
}

std::vector<double> times_of(const scene::MotionKeys& motion) {
  std::vector<double> times;
  const auto steps = static_cast<std::uint64_t>(motion.steps), count = std::min(steps, most_times);
  for (std::uint64_t k = 1; k <= count; ++k) {
    const std::uint64_t step = steps * k / count;
    times.push_back(static_cast<double>(step) * motion.time_step);
  }
  return times;
}

scene::Scene at_rest_scene(const BudgetOptions& o, scene::Scene scene) {
  scene.relax.threshold = std::min(scene.relax.threshold, at_rest);
  scene.relax.max_sweeps = std::max(scene.relax.max_sweeps, o.rest_sweeps);
  return scene;
}

/// `p` and the array's level outlive the motions.
std::vector<Link> chain_of(const BudgetOptions& o, const levels::Prepared& p,
                           const levels::ReadyLevel& array) {
  const scene::Scene& scene = p.inputs.scene;
  std::vector<Link> chain;
  const std::shared_ptr<levels::Mover> run(std::shared_ptr<void>(), array.mover.get());
  chain.push_back({fmt::format("array {}", p.inputs.array.name), "quantisation", run, {}});
  chain.push_back({"reference, the same sweeps at most and threshold",
                   "unfinished relaxation",
                   std::make_shared<levels::ReferenceMover>(scene, *p.mesh, p.inputs.array),
                   {}});
  chain.push_back({"reference, relaxed to rest",
                   "formulation",
                   std::make_shared<levels::ReferenceMover>(at_rest_scene(o, scene), *p.mesh, p.inputs.array),
                   {}});
  if (levels::ExactStep::exists_for(scene))
    chain.push_back({scene.formulation_name() + ", each step solved exactly",
                     "time step",
                     std::make_shared<levels::ExactStep>(scene, *p.mesh),
                     {}});
  return chain;
}

/// Flies one motion; false where it was interrupted.
bool fly(const levels::Prepared& p, Link& link, Budget& budget) {
  const scene::MotionKeys& motion = p.inputs.scene.motion;
  const auto steps = static_cast<std::uint64_t>(motion.steps);
  run::Snapshots snapshots(budget.times, motion.time_step);
  run::Progress progress(steps);
  const run::RunResult result =
      run::simulate(*link.made, steps, {&snapshots, &progress}, levels::stop_requested);
  if (result.outcome == run::Outcome::diverged)
    budget.troubles.push_back(fmt::format("{}: {}", link.motion, result.sentence));
  const std::uint64_t unfinished =
      run::count_of(result.rows, &levels::StepRow::converged, levels::Summary::unmet);
  if (unfinished > 0)
    link.motion += fmt::format(" ({} of {} steps ended by their sweeps)", unfinished, steps);
  link.at = std::move(snapshots.at);
  return result.outcome != run::Outcome::interrupted;
}

void add_truth(const levels::Prepared& p, const fs::path& folder, Budget& budget) {
  const study::Truth truth = study::TruthStore(folder).at(p.inputs, *p.mesh, budget.times);
  if (truth.positions.empty())
    budget.troubles.emplace_back("truth: SUNDIALS gave up, so there is nothing to measure against");
  budget.floor = truth.floor;
  budget.chain.push_back(
      {"truth: m dv/dt = springs - m c v + m force, by SUNDIALS", "", nullptr, truth.positions});
}

void work_out(Budget& budget) {
  for (std::size_t k = 0; k < budget.times.size(); ++k) {
    std::vector<const run::Positions*> positions;
    for (const Link& link : budget.chain)
      if (k < link.at.size() && !link.at[k].empty()) positions.push_back(&link.at[k]);
    if (positions.size() < budget.chain.size()) return;
    budget.rows.push_back(study::budget_of(positions));
    budget.rows.back().time = budget.times[k];
    budget.rows.back().floor = budget.floor[k];
  }
}

std::vector<std::string> parts_of(const Budget& budget) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k + 1 < budget.chain.size(); ++k) names.push_back(budget.chain[k].mends);
  return names;
}

void print(const levels::Prepared& p, const Budget& budget) {
  fmt::print("{}: whose part of the distance from the truth is how large\n", p.inputs.scene.name);
  for (std::size_t k = 0; k + 1 < budget.chain.size(); ++k)
    fmt::print("  {:<22} {}\n  {:<22} less {}\n", budget.chain[k].mends, budget.chain[k].motion, "",
               budget.chain[k + 1].motion);
  if (!levels::ExactStep::exists_for(p.inputs.scene))
    fmt::print(
        "The probe has no exact step that tends to this physics, so its time step has no part of its own: "
        "formulation\nis all that lies between its rest and the truth.\n");
  if (budget.rows.empty()) return;
  fmt::print(
      "Rms over nodes, m, and share of the whole (by projection: shares add up to 100 %)\n{:>9}{:>11}{:>11}",
      "time, s", "whole", "floor");
  for (const std::string& name : parts_of(budget)) fmt::print("{:>24}", name);
  for (const study::BudgetAt& row : budget.rows) {
    fmt::print("\n{:>9.4g}{:>11.2e}{:>11.1e}", row.time, row.total, row.floor);
    for (const auto& part : row.parts) fmt::print("{:>13.2e}{:>+9.1f} %", part.norm, 100 * part.share);
  }
  fmt::print("\n");
}

void write_table(const fs::path& file, const Budget& budget) {
  std::vector<std::string> columns{"time", "total", "truth_floor"};
  for (std::string name : parts_of(budget)) {
    std::replace(name.begin(), name.end(), ' ', '_');
    columns.push_back(name);
    columns.push_back(name + "_share");
  }
  files::CsvWriter table(file, columns);
  for (const study::BudgetAt& row : budget.rows) {
    table.cell(row.time).cell(row.total).cell(row.floor);
    for (const auto& part : row.parts) table.cell(part.norm).cell(part.share);
    table.end_row();
  }
  table.commit();
}

pictures::StackedBars picture_of(const levels::Prepared& p, const Budget& budget) {
  pictures::StackedBars bars;
  bars.title = p.inputs.scene.name + ": where the distance from the truth comes from";
  bars.note = fmt::format("array {}; Δt = {} s", p.inputs.array.name, p.inputs.scene.motion.time_step);
  bars.x_label = "time, s", bars.y_label = "rms over nodes, m";
  bars.stacked_title = "shares: what is above 0 less what is below is the whole";
  bars.length_title = "each part by itself";
  bars.floor_name = "truth floor";
  for (const std::string& name : parts_of(budget)) bars.parts.push_back({name, {}, {}});
  for (const study::BudgetAt& row : budget.rows) {
    bars.x.push_back(row.time);
    bars.floor.push_back(row.floor);
    for (std::size_t k = 0; k < row.parts.size(); ++k) {
      bars.parts[k].stacked.push_back(row.parts[k].share * row.total);
      bars.parts[k].length.push_back(row.parts[k].norm);
    }
  }
  return bars;
}

int budget(const BudgetOptions& o) {
  levels::Prepared p = prepare(o.common);
  set_steps(o, p);
  rivals::surroundings_of(p.inputs.scene); // refuses what has no truth, before the work
  const fs::path folder = o.out.empty() ? default_folder(p.inputs.scene.name + "-budget") : o.out;
  files::check_writable(folder, 0);
  levels::catch_interrupts();
  const levels::ReadyLevel array = levels::make_ready(levels::default_level(), p);
  Budget budget;
  budget.times = times_of(p.inputs.scene.motion);
  budget.chain = chain_of(o, p, array);
  for (Link& link : budget.chain)
    if (!fly(p, link, budget)) return interrupted;
  add_truth(p, folder, budget);
  work_out(budget);
  print(p, budget);
  for (const std::string& trouble : budget.troubles) fmt::print("{}\n", trouble);
  if (!budget.rows.empty()) {
    write_table(folder / "budget.csv", budget);
    files::write_file(folder / "budget.svg", pictures::svg_of(picture_of(p, budget)));
    fmt::print("Results\n  {}\n  {}\n", (folder / "budget.csv").string(), (folder / "budget.svg").string());
  }
  return budget.troubles.empty() ? done : differs;
}

} // namespace

void add_budget(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<BudgetOptions>();
  CLI::App* verb = program.add_subcommand(
      "budget", "what a run's distance from the truth is made of: words, sweeps, formulation, step");
  add_common(*verb, o->common);
  auto* steps =
      verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--time", o->time, "seconds to do, instead")->check(positive_number())->excludes(steps);
  verb->add_option("--rest-sweeps", o->rest_sweeps,
                   "at most so many sweeps a step where the reference relaxes to rest")
      ->check(whole_number(1))
      ->capture_default_str();
  verb->add_option("--out", o->out, "results folder (out/NAME-budget): budget.csv, budget.svg, the truth");
  verb->footer("Example:\n  hopmesh budget banner --time 0.1 --out out/budget\n"
               "Exit: 0 done, 1 a motion diverged (the budget ends before), 2 bad input, 130 interrupted.");
  verb->callback([o, &exit_code] { exit_code = budget(*o); });
}

} // namespace hopmesh::cli
