// hopmesh compare: levels beside each other.
#include "sim/cosim/compare.h"

#include "sim/cli/options.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/progress.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct CompareOptions {
  input::InputWords words;
  std::vector<std::string> levels = levels::compared_names();
  std::int64_t steps = 0;
};

int compare(const CompareOptions& o) {
  std::vector<const levels::Level*> rows;
  for (const std::string& name : o.levels)
    rows.push_back(&levels::level_named(name, "--levels", levels::sweeping));
  const levels::Prepared p = prepare(with_steps(o.words, o.steps));
  const auto is_reference = [](const levels::Level* l) { return l->kind == levels::Kind::reference; };
  std::stable_partition(rows.begin(), rows.end(), is_reference);
  for (const std::string& level : o.levels)
    if (std::count(o.levels.begin(), o.levels.end(), level) > 1)
      throw input::input_error("", 0, "--levels", level + " twice", "each level once");
  if (o.levels.size() < 2)
    throw input::input_error("", 0, "--levels", o.levels[0] + " alone", "at least two levels");
  const bool check = is_reference(rows[0]);
  std::vector<levels::ReadyLevel> ready;
  levels::PortRequest request;
  request.remarks = true;
  for (const levels::Level* row : rows) ready.push_back(levels::make_ready(*row, p, check, request));

  levels::catch_interrupts();
  cosim::Comparison comparison;
  {
    const auto steps = static_cast<std::uint64_t>(p.inputs.scene.motion.steps);
    run::Progress progress(steps);
    comparison = cosim::compare(
        ready, *p.mesh, p.inputs.array, steps, [&](const levels::StepRow& row) { progress.step(row); },
        levels::stop_requested);
  }
  fmt::print("{}", cosim::text_of(comparison, text_of(o.words), p.inputs.array));
  if (comparison.outcome == run::Outcome::interrupted) return interrupted;
  return comparison.difference ? differs : exit_of(comparison.outcome);
}

} // namespace

void add_compare(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* verb = program.add_subcommand(
      "compare", "levels beside each other: bits, cycles, error against the reference");
  add_common(*verb, o->words);
  verb->add_option("--levels", o->levels,
                   fmt::format("two or more of {}", fmt::join(levels::level_names(levels::sweeping), ", ")))
      ->delimiter(',');
  verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->footer("Example:\n  hopmesh compare two-nodes --levels reference,engine,systemc --steps 10\n"
               "Exit: 0 fixed levels are equal, 1 they differ or the motion diverged, 2 bad input.");
  verb->callback([o, &exit_code] { exit_code = compare(*o); });
}

} // namespace hopmesh::cli
