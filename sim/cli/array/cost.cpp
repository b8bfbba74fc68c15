// hopmesh cost: what an array costs in cells, area, clock and energy.
#include "sim/cli/options.h"
#include "sim/input/standard_streams.h"
#include "sim/run/array_info.h"
#include "sim/run/design/array_cost.h"

#include <fmt/format.h>
#include <mutex>

namespace hopmesh::cli {

namespace {

struct CostWords {
  input::InputWords words;
  std::string out;
  bool model = false, no_place = false, json = false, point = false;
  std::int64_t sweeps = 0, workers = 0;
};

int cost(const CostWords& o) {
  const levels::Prepared p = prepare(o.words);
  run::CostOrder order;
  order.step = run::longest_step(p.inputs.scene);
  if (o.sweeps > 0) order.step.sweeps = static_cast<std::uint64_t>(o.sweeps);
  order.measure = !o.model;
  order.place = !o.no_place;
  order.workers = workers_of(o.workers);
  order.out = o.out;
  std::mutex mutex;
  const run::CostReport report = run::array_cost(p, order, [&mutex](const std::string& what) {
    const std::lock_guard<std::mutex> lock(mutex);
    input::say(fmt::format("hopmesh: {}\n", what));
  });
  tell(report.notes);
  if (o.point)
    fmt::print("{}", report.point);
  else if (o.json)
    fmt::print("{}", report.json);
  else
    fmt::print("{}, array {}\n{}", p.inputs.scene.name, p.inputs.array.name, run::text_of(report.tables));
  return done;
}

} // namespace

void add_cost(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<CostWords>();
  CLI::App* verb =
      program.add_subcommand("cost", "what the array costs: cells, area, clock, energy of a step");
  add_common(*verb, o->words);
  verb->add_option("--out", o->out, "folder for cost.json and what the tools write (neither is kept)");
  verb->add_flag("--model", o->model, "no tool runs: the fitted model alone, at once");
  verb->add_flag("--no-place", o->no_place, "nothing is placed and routed, which takes longest");
  verb->add_flag("--json", o->json, "the figures as one JSON object");
  verb->add_flag("--point", o->point, "the measured parts as rows of sim/machine/cost/points.csv");
  verb->add_option("--sweeps", o->sweeps,
                   "sweeps of the step whose energy is told (as many as the scene allows)")
      ->check(whole_number(1));
  verb->add_option("-j", o->workers, "tools at a time (as many as processors)")->check(whole_number(1));
  verb->footer("Example:\n  hopmesh cost flag-400 --array folded --model");
  verb->callback([o, &exit_code] { exit_code = cost(*o); });
}

} // namespace hopmesh::cli
