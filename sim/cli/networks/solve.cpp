// hopmesh solve: any network that somebody brings, or one of the problem set, relaxed at any level.
#include "rtl_model/spec/array_rules.h"
#include "sim/cli/options.h"
#include "sim/files/output_file.h"
#include "sim/input/array_file.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/networks/problems/problem.h"
#include "sim/networks/solution.h"
#include "sim/run/progress.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct SolveRequest {
  networks::NetworkFiles files;
  std::string rule, level = levels::default_level().name, array, out;
  std::vector<std::string> overrides;
  std::int64_t sweeps = 10'000, seed = 0;
  double threshold = 1e-4;
};

/// What is to be solved, from files or from the problem set.
struct Task {
  std::string name;
  networks::NetworkData data;
  std::string rule; ///< empty: the array's
  std::function<std::string(const std::vector<double>&)> verdict;
};

// A file has a folder or an ending; a bare word is a name.
bool is_name(const std::string& word) {
  return word.find_first_of("/.") == std::string::npos;
}

Task task_of_problem(const SolveRequest& o) {
  const std::string& name = o.files.weights;
  check_problem(name, "W");
  if (!o.files.bias.empty())
    throw input::input_error("", 0, "BIAS", o.files.bias, "none: a problem has its own");
  problems::Problem p = problems::make(name, static_cast<std::uint64_t>(std::max<std::int64_t>(1, o.seed)));
  Task task{name,
            {std::move(p.W), std::move(p.bias), std::move(p.start)},
            p.binary ? "binary" : "modified",
            std::move(p.verdict)};
  if (!o.files.start.empty()) task.data.start = networks::read_start(o.files.start, task.data.W.rows);
  return task;
}

Task task_of(const SolveRequest& o) {
  if (is_name(o.files.weights)) return task_of_problem(o);
  if (o.seed > 0) throw input::input_error("", 0, "--seed", "a file", "the name of a problem");
  return {o.files.weights, networks::read_network(o.files), "", nullptr};
}

using Overrides = std::vector<std::pair<std::string, std::string>>;

Overrides overrides_of(const SolveRequest& o) {
  Overrides overrides;
  for (const std::string& text : o.overrides) overrides.push_back(input::split_override(text));
  return overrides;
}

// A rule is the array's output stage under the paper's name: --rule and --set array.output are two words for
// one thing and must not contradict each other. Either goes before the problem's own.
void apply_rule(const SolveRequest& o, const Overrides& overrides, const Task& task, spec::ArraySpec& array) {
  const bool is_set = std::any_of(overrides.begin(), overrides.end(),
                                  [](const auto& pair) { return pair.first == "array.output"; });
  if (is_set && !o.rule.empty() && o.rule != spec::name_of(array.output))
    throw input::input_error(
        "", 0, "--rule", o.rule + " beside --set array.output=" + std::string(spec::name_of(array.output)),
        "one of the two, or the same in both");
  const std::string rule = !o.rule.empty() ? o.rule : is_set ? "" : task.rule;
  if (!rule.empty()) array.output = *spec::mode_named<spec::Output>(rule, spec::output_names);
}

void check_array(const spec::ArraySpec& array, const spec::Topology& topology, const std::string& file) {
  if (const auto fault = spec::validate(array, topology.most_taps()))
    throw input::input_error(file, 0, fault->key, fault->found, fault->expected);
}

int finish(const SolveRequest& o, const Task& task, const networks::GivenNetwork& network,
           networks::NetworkLevel& level, networks::SolveLabel label) {
  const networks::Solution solution =
      networks::solve(network, level, {o.threshold, static_cast<std::uint32_t>(o.sweeps)});
  if (task.verdict) label.verdict = task.verdict({solution.V.data(), solution.V.data() + solution.V.size()});
  if (!o.out.empty()) {
    networks::write_sweeps(std::filesystem::path(o.out) / "solve.csv", network, level, solution,
                           levels::stop_requested);
    networks::write_solution(o.out, label, network, solution);
  }
  fmt::print("{}", networks::text_of(label, network, solution));
  return solution.rest.converged ? done : differs;
}

int solve(const SolveRequest& o) {
  const levels::Level& row = levels::level_named(o.level, "--level", levels::sweeping);
  if (!(o.threshold >= 0 && o.threshold <= 2))
    throw input::input_error("", 0, "--threshold", fmt::format("{}", o.threshold), "a number from 0 to 2");
  if (!o.rule.empty()) check_name(o.rule, "--rule", {spec::output_names.begin(), spec::output_names.end()});
  const Overrides overrides = overrides_of(o);
  std::vector<std::string> notes;
  spec::ArraySpec array = input::read_array(o.array, overrides, notes);
  tell(notes);
  const Task task = task_of(o);
  tell(task.data.notes);
  apply_rule(o, overrides, task, array);
  const networks::GivenNetwork network(task.data, array.output == spec::Output::binary ? 1.0 : 0.0);
  check_array(array, network.topology(), o.array);
  if (!o.out.empty()) files::check_writable(o.out, network.neurons() * 32);
  levels::catch_interrupts();
  levels::PortRequest request;
  request.remarks = true;
  std::unique_ptr<levels::ArrayPort> port;
  if (row.has_bus()) port = row.make_port(array, network.topology(), request);
  const auto level =
      port ? networks::array_level(network, array, *port) : networks::reference_level(network, array);
  try {
    return finish(o, task, network, *level,
                  {task.name, o.level, std::string(spec::name_of(array.output)),
                   std::string(spec::name_of(array.schedule)), ""});
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
                   "modified | binary: array.output; none: as the problem or the array has it");
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
  verb->add_option("--seed", o->seed, "of a problem's start")->check(whole_number(1));
  verb->add_option("--out", o->out, "folder for V.mtx, solve.csv, summary.json");
  verb->footer("Example:\n  hopmesh solve box-random-100 --out out/box\n"
               "Exit: 0 at rest; 1 not at rest after --sweeps (results are written); 2 bad input.");
  verb->callback([o, &exit_code] { exit_code = solve(*o); });
}

} // namespace hopmesh::cli
