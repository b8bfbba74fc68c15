// hopmesh size: the least array that meets an error on a scene, and what shows that it is.
#include "sim/study/size/size.h"

#include "sim/cli/options.h"
#include "sim/levels/interrupt.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct SizeOptions {
  study::SizeOrder order;
  std::string out;
  std::int64_t workers = 0;
};

int size(SizeOptions& o) {
  levels::catch_interrupts();
  levels::Prepared p = prepare(o.order.words);
  if (o.order.steps > 0) p.inputs.scene.motion.steps = o.order.steps;
  o.order.workers = workers_of(o.workers);
  const auto folder = results_folder(o.out, p.inputs.scene.name + "-size");
  const study::SizeEnd end = study::size_array(o.order, p, folder);
  fmt::print("{}", end.text);
  return exit_of(end.outcome);
}

} // namespace

void add_size(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<SizeOptions>();
  CLI::App* verb = program.add_subcommand("size", "the least array that meets an error, with the evidence");
  add_common(*verb, o->order.words);
  verb->add_option("--error", o->order.error, "rms of positions at the end, m")
      ->required()
      ->check(positive_number());
  verb->add_option("--against", o->order.against, "reference (its free motion), or truth")
      ->check(one_name_of(study::size_judges()))
      ->capture_default_str();
  verb->add_option("--time-per-step", o->order.time_per_step,
                   "s: the fewest lanes that do the slowest step in so long, bus included (else: least "
                   "silicon times cycles of array and bus)")
      ->check(positive_number());
  verb->add_option("--steps", o->order.steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--out", o->out,
                   "results folder (out/NAME-size): size.toml, size.csv; one that is there is gone on with");
  verb->add_option("-j", o->workers, "so many trials at a time (as many as processors); changes no result")
      ->check(whole_number(1, 1024));
  verb->footer(
      "Example:\n  hopmesh size two-nodes --steps 20 --error 0.001 --out out/two-nodes-size\n"
      "Exit: 0 done, 1 no array reaches the error or the time, 2 bad input, 130 interrupted (the same "
      "command goes on).");
  verb->callback([o, &exit_code] { exit_code = size(*o); });
}

} // namespace hopmesh::cli
