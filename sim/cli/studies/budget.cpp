// hopmesh budget: how much of a run's distance from the truth is whose.
#include "sim/study/budget/budget.h"

#include "sim/cli/options.h"
#include "sim/levels/interrupt.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct BudgetOptions {
  input::InputWords words;
  std::string out;
  std::int64_t steps = 0;
  double time = 0;
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

int budget(const BudgetOptions& o) {
  levels::Prepared p = prepare(o.words);
  set_steps(o, p);
  const auto folder = results_folder(o.out, p.inputs.scene.name + "-budget");
  study::check_budget(p, folder);
  levels::catch_interrupts();
  const auto budget = study::work_out_budget(p, folder);
  if (!budget) return interrupted;
  fmt::print("{}", study::text_of(p, *budget));
  if (!budget->rows.empty()) {
    study::write_budget(folder, p, *budget);
    fmt::print("Results\n  {}\n  {}\n", (folder / "budget.csv").string(), (folder / "budget.svg").string());
  }
  return budget->troubles.empty() ? done : differs;
}

} // namespace

void add_budget(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<BudgetOptions>();
  CLI::App* verb = program.add_subcommand(
      "budget", "what a run's distance from the truth is made of: rounding, stopping, formulation, step");
  add_common(*verb, o->words);
  auto* steps =
      verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--time", o->time, "seconds to do, instead")->check(positive_number())->excludes(steps);
  verb->add_option("--out", o->out, "results folder (out/NAME-budget): budget.csv, budget.svg, the truth");
  verb->footer("Example:\n  hopmesh budget banner --time 0.1 --out out/budget\n"
               "Exit: 0 done, 1 a motion diverged (the budget ends before), 2 bad input, 130 interrupted.");
  verb->callback([o, &exit_code] { exit_code = budget(*o); });
}

} // namespace hopmesh::cli
