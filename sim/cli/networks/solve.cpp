// hopmesh solve: any network that somebody brings, or one of the problem set, relaxed at any level.
#include "sim/cli/options.h"
#include "sim/input/array_file.h"
#include "sim/networks/solve_task.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct SolveRequest {
  networks::NetworkFiles files;
  std::string rule, level = levels::default_level().name, array, out;
  std::vector<std::string> overrides;
  std::int64_t sweeps = 10'000, seed = 0, refinements = 0;
  double threshold = 1e-4, share = 0x1p-13;
  std::string stop = "change";
  std::vector<double> momentum;
};

levels::RelaxOptions options_of(const SolveRequest& o) {
  check_name(o.stop, "--stop", {"change", "sum"});
  if (!(o.threshold >= 0 && o.threshold <= 2))
    throw input::input_error("", 0, "--threshold", fmt::format("{}", o.threshold), "a number from 0 to 2");
  if (!(o.share >= 0 && o.share <= 0.5))
    throw input::input_error("", 0, "--share", fmt::format("{}", o.share), "a number from 0 to 0.5");
  for (const double m : o.momentum)
    if (!(m >= 0 && m <= 1))
      throw input::input_error("", 0, "--momentum", fmt::format("{}", m), "numbers from 0 to 1");
  levels::RelaxOptions options{o.threshold, static_cast<std::uint32_t>(o.sweeps), {}, o.momentum};
  if (o.stop == "sum") options.share = o.share;
  return options;
}

// A rule is the array's output stage under the paper's name: --rule and --set array.output are two words for
// one thing.
bool sets_output(const std::pair<std::string, std::string>& override) {
  return override.first == "array.output";
}

int solve(const SolveRequest& o) {
  const levels::Level& level = levels::level_named(o.level, "--level", levels::sweeping);
  const levels::RelaxOptions options = options_of(o);
  if (!o.rule.empty()) check_name(o.rule, "--rule", networks::rule_names());
  std::vector<std::pair<std::string, std::string>> overrides;
  for (const std::string& text : o.overrides) overrides.push_back(input::split_override(text));
  std::vector<std::string> notes;
  auto array = input::read_array(o.array, overrides, notes);
  tell(notes);
  const networks::SolveTask task = networks::read_task(o.files, o.seed);
  tell(task.data.notes);
  const bool is_set = std::any_of(overrides.begin(), overrides.end(), sets_output);
  networks::apply_rule(o.rule, is_set, task, array);
  try {
    const networks::TaskEnd end = networks::solve_task(task, array, o.array, level, options, o.out,
                                                       static_cast<std::uint32_t>(o.refinements));
    tell(end.notes);
    fmt::print("{}", end.text);
    return end.at_rest ? done : differs;
  } catch (const levels::Stopped&) {
    return interrupted;
  }
}

} // namespace

void add_solve(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<SolveRequest>();
  CLI::App* verb =
      program.add_subcommand("solve", "any network in Matrix Market files, or one of the problem set");
  verb->add_option("W", o->files.weights, "weights: a Matrix Market file, or the name of a problem")
      ->required();
  verb->add_option("BIAS", o->files.bias, "biases, one column; none: 0");
  verb->add_option("--start", o->files.start,
                   "outputs at the start, one column from -1 to 1; none: 0, or 1 where binary");
  verb->add_option("--rule", o->rule,
                   fmt::format("{}: array.output; none: as the problem or the array has it",
                               fmt::join(networks::rule_names(), " | ")));
  verb->add_flag("--asymmetric", o->files.asymmetric, "W may be so: then nothing says that energy falls");
  verb->add_option("--level", o->level,
                   fmt::format("{}", fmt::join(levels::level_names(levels::sweeping), " | ")))
      ->capture_default_str();
  verb->add_option("--array", o->array, "an array file, or the name of a preset");
  verb->add_option("--set", o->overrides, "key.path=value: overrides a key of the array")
      ->allow_extra_args(false);
  verb->add_option("--sweeps", o->sweeps, "at most so many")->check(whole_number(1))->capture_default_str();
  verb->add_option("--threshold", o->threshold, "at rest when no output moves by more in a sweep")
      ->capture_default_str();
  verb->add_option(
          "--stop", o->stop,
          "change | sum: at rest by how far outputs move, or by the inputs of those that may still move")
      ->capture_default_str();
  verb->add_option("--share", o->share,
                   "with --stop sum: at rest at this share of the first sweep's largest input")
      ->capture_default_str();
  verb->add_option("--momentum", o->momentum, "m of array.output = momentum, sweep by sweep; none: FISTA's")
      ->delimiter(',');
  verb->add_option("--refinements", o->refinements,
                   "corrections of the answer by its residual in double, at most so many (0)")
      ->check(whole_number(0, 1000));
  verb->add_option("--seed", o->seed, "of a problem's start")->check(whole_number(1));
  verb->add_option("--out", o->out, "folder for V.mtx, solve.csv, summary.json");
  verb->footer("Example:\n  hopmesh solve box-random-100 --out out/box\n"
               "Exit: 0 at rest; 1 not at rest after --sweeps (results are written); 2 bad input.");
  verb->callback([o, &exit_code] { exit_code = solve(*o); });
}

} // namespace hopmesh::cli
