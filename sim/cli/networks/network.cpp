// hopmesh network: the network of one step as files that other programs read.
#include "sim/cli/options.h"
#include "sim/files/matrix_market.h"
#include "sim/files/npy.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/progress.h"
#include "sim/run/simulation.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct NetworkOptions {
  CommonOptions common;
  std::int64_t step = 0;
  std::string out;
};

void write_files(const std::filesystem::path& folder, const reference::Step& step) {
  std::vector<files::MatrixEntry> entries;
  for (Eigen::Index row = 0; row < step.network.W.outerSize(); ++row)
    for (reference::Matrix::InnerIterator at(step.network.W, row); at; ++at)
      entries.push_back({static_cast<std::size_t>(at.row()), static_cast<std::size_t>(at.col()), at.value()});
  const auto n = static_cast<std::size_t>(step.network.W.rows());
  const auto values = [](const reference::Vector& v) {
    return std::vector<double>(v.data(), v.data() + v.size());
  };
  files::write_matrix(folder / "W.mtx", n, n, entries);
  files::write_vector(folder / "bias.mtx", values(step.network.I));
  files::write_vector(folder / "V0.mtx", values(step.V0));
  files::write_vector(folder / "V.mtx", values(step.relaxation.V));
  files::NpyWriter<double> predicted(folder / "predicted.npy", std::vector<std::size_t>{3});
  const auto C = values(step.predicted);
  for (std::size_t node = 0; node < C.size() / 3; ++node) predicted.append(&C[3 * node]);
  predicted.commit();
}

int network(NetworkOptions& o) {
  const levels::Prepared p = prepare(o.common);
  if (o.step >= p.inputs.scene.motion.steps)
    throw input::input_error("", 0, "--step", std::to_string(o.step),
                             fmt::format("0 to {} (the scene's steps)", p.inputs.scene.motion.steps - 1));
  files::check_writable(o.out, p.mesh->topology().weight_words() * 48 + p.mesh->nodes() * 256);
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  levels::catch_interrupts();
  run::RunResult result;
  {
    const auto steps = static_cast<std::uint64_t>(o.step) + 1;
    run::Progress progress(steps);
    result = run::simulate(motion, steps, {&progress}, levels::stop_requested);
  }
  if (result.outcome == run::Outcome::interrupted) return interrupted;
  if (result.rows.size() <= static_cast<std::size_t>(o.step)) {
    fmt::print("{}\n", result.sentence);
    return differs;
  }
  write_files(o.out, motion.last_step());
  const levels::StepRow& row = result.rows.back();
  fmt::print("{} step {}: {}, {}, {}; written to {}\n", p.inputs.scene.name, o.step,
             input::with_noun(static_cast<std::uint64_t>(motion.last_step().network.W.nonZeros()), "weight"),
             input::with_noun(row.sweeps, "sweep"), row.converged ? "converged" : "stopped by max_sweeps",
             o.out);
  if (motion.formulation().increment)
    fmt::print("An output of 1 is a change of acceleration of {} m/s^2.\n", motion.last_step().scale);
  return done;
}

} // namespace

void add_network(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<NetworkOptions>();
  CLI::App* verb =
      program.add_subcommand("network", "the network of one step in Matrix Market files (reference level)");
  add_common(*verb, o->common);
  verb->add_option("--step", o->step, "the step, counted from 0")->required()->check(whole_number(0));
  verb->add_option("--out", o->out, "folder for W.mtx, bias.mtx, V0.mtx, V.mtx, predicted.npy")->required();
  verb->footer("Example:\n  hopmesh network two-nodes --step 3 --out out/network");
  verb->callback([o, &exit_code] { exit_code = network(*o); });
}

} // namespace hopmesh::cli
