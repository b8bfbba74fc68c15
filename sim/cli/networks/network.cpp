// hopmesh network: the network of one step as files that other programs read.
#include "sim/cli/options.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/networks/step_files.h"
#include "sim/run/progress.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct NetworkOptions {
  input::InputWords words;
  std::int64_t step = 0;
  std::string out;
};

int network(const NetworkOptions& o) {
  const levels::Prepared p = prepare(o.words);
  check_step(o.step, p);
  networks::check_step_files(o.out, *p.mesh);
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  levels::catch_interrupts();
  const run::RunResult result = run::simulate_shown(motion, static_cast<std::uint64_t>(o.step) + 1);
  if (result.outcome == run::Outcome::interrupted) return interrupted;
  if (result.rows.size() <= static_cast<std::size_t>(o.step)) {
    fmt::print("{}\n", result.sentence);
    return differs;
  }
  networks::write_step_files(o.out, motion);
  const levels::StepRow& row = result.rows.back();
  fmt::print("{} step {}: {}, {}, {}; written to {}\n", p.inputs.scene.name, o.step,
             input::with_noun(static_cast<std::uint64_t>(motion.last_step().network.W.nonZeros()), "weight"),
             input::with_noun(row.sweeps, "sweep"), row.converged ? "converged" : "stopped by max_sweeps",
             o.out);
  if (motion.formulation().increment)
    fmt::print("An output of 1 is a change of acceleration of {} m/s^2.\n", motion.last_step().scale);
  fmt::print("{}", networks::certain_text(motion, p));
  return done;
}

} // namespace

void add_network(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<NetworkOptions>();
  CLI::App* verb =
      program.add_subcommand("network", "the network of one step in Matrix Market files (reference level)");
  add_common(*verb, o->words);
  verb->add_option("--step", o->step, "the step, counted from 0")->required()->check(whole_number(0));
  verb->add_option("--out", o->out, "folder for W.mtx, bias.mtx, V0.mtx, V.mtx, predicted.npy")->required();
  verb->footer("Example:\n  hopmesh network two-nodes --step 3 --out out/network");
  verb->callback([o, &exit_code] { exit_code = network(*o); });
}

} // namespace hopmesh::cli
