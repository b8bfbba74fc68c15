#include "sim/networks/solve_task.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/files/folder_lock.h"
#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/prepared.h"
#include "sim/networks/problems/problem.h"

#include <algorithm>
#include <optional>

namespace hopmesh::networks {

namespace {

// A file has a folder or an ending; a bare word is a name.
bool is_name(const std::string& word) {
  return word.find_first_of("/.") == std::string::npos;
}

SolveTask task_of_problem(const NetworkFiles& files, std::int64_t seed) {
  const std::string& name = files.weights;
  problems::check_name(name, "W");
  if (!files.bias.empty()) throw input::input_error("", 0, "BIAS", files.bias, "none: a problem has its own");
  problems::Problem p = problems::make(name, static_cast<std::uint64_t>(std::max<std::int64_t>(1, seed)));
  SolveTask task{name,
                 {std::move(p.W), std::move(p.bias), std::move(p.start)},
                 p.binary ? "binary" : "modified",
                 std::move(p.verdict)};
  if (!files.start.empty()) task.data.start = read_start(files.start, task.data.W.rows);
  return task;
}

void check_array(const spec::ArraySpec& array, const spec::Topology& topology, const std::string& file) {
  if (const auto fault = spec::validate_on(array, topology))
    throw input::input_error(file, 0, fault->key, fault->found, fault->expected);
}

void check_momentum(const spec::ArraySpec& array, std::size_t entries) {
  if (entries == 0) return;
  if (!spec::has_momentum(array))
    throw input::input_error("", 0, "--momentum",
                             "array.output = " + std::string(spec::name_of(array.output)),
                             "momentum, whose table it is");
  if (entries > static_cast<std::size_t>(array.momentum_entries))
    throw input::input_error("", 0, "--momentum", std::to_string(entries) + " numbers",
                             "at most the " + std::to_string(array.momentum_entries) +
                                 " of array.momentum_entries");
}

bool is_symmetric(const GivenNetwork& network) {
  const auto& W = network.network().W;
  std::decay_t<decltype(W)> mirrored = W.transpose();
  return (W - mirrored).norm() == 0;
}

// A correction is a network with the same weights and other biases, taken where the energy falls.
void check_refinements(const spec::ArraySpec& array, const GivenNetwork& network) {
  if (!is_symmetric(network))
    throw input::input_error("", 0, "--refinements", "a W that is not symmetric",
                             "a symmetric one: no energy tells whether a correction is good");
  if (array.output == spec::Output::binary)
    throw input::input_error("", 0, "--refinements", "outputs that are signs",
                             "array.output of real outputs: no correction makes a sign truer");
  if (array.normaliser == spec::Normaliser::prescaled)
    throw input::input_error("", 0, "--refinements", "array.normaliser = prescaled",
                             "divider or reciprocal: prescaled weights know the biases");
}

} // namespace

SolveTask read_task(const NetworkFiles& files, std::int64_t seed) {
  if (is_name(files.weights)) return task_of_problem(files, seed);
  if (seed > 0) throw input::input_error("", 0, "--seed", "a file", "the name of a problem");
  return {files.weights, read_network(files), "", nullptr};
}

std::vector<std::string> rule_names() {
  return {spec::output_names.begin(), spec::output_names.end()};
}

void apply_rule(const std::string& rule, bool is_set, const SolveTask& task, spec::ArraySpec& array) {
  const std::string own(spec::name_of(array.output));
  if (is_set && !rule.empty() && rule != own)
    throw input::input_error("", 0, "--rule", rule + " beside --set array.output=" + own,
                             "one of the two, or the same in both");
  const std::string& wanted = !rule.empty() ? rule : is_set ? own : task.rule;
  if (!wanted.empty()) array.output = *spec::mode_named<spec::Output>(wanted, spec::output_names);
}

TaskEnd solve_task(const SolveTask& task, const spec::ArraySpec& array, const std::string& file,
                   const levels::Level& row, const levels::RelaxOptions& options,
                   const std::filesystem::path& folder, std::uint32_t refinements) {
  const GivenNetwork network(task.data, array.output == spec::Output::binary ? 1.0 : 0.0);
  check_array(array, network.topology(), file);
  check_momentum(array, options.momentum.size());
  if (refinements > 0) check_refinements(array, network);
  if (!folder.empty()) files::check_writable(folder, network.neurons() * 32);
  std::optional<files::FolderLock> lock; // before the work: two of them would mix their files
  if (!folder.empty()) lock.emplace(folder);
  levels::catch_interrupts();
  levels::PortRequest request;
  request.remarks = true;
  std::unique_ptr<levels::ArrayPort> port;
  if (row.has_bus()) port = row.make_port(array, network.topology(), request);
  const auto level =
      port ? array_level(network, array, options, *port) : reference_level(network, array, options);
  Solution solution = solve(network, *level, !spec::has_momentum(array));
  SolveLabel label{task.name, row.name, std::string(spec::name_of(array.output)),
                   std::string(spec::name_of(array.schedule)), ""};
  if (!folder.empty()) write_sweeps(folder / "solve.csv", network, *level, solution, levels::stop_requested);
  if (refinements > 0) refine(network, *level, refinements, solution);
  if (task.verdict) label.verdict = task.verdict({solution.V.data(), solution.V.data() + solution.V.size()});
  if (!folder.empty()) write_solution(folder, label, network, solution);
  TaskEnd end{text_of(label, network, solution), solution.rest.converged, {}};
  levels::tell_of_fold(array, network.topology(), end.notes);
  if (spec::has_momentum(array) && !is_symmetric(network))
    end.notes.emplace_back("W is not symmetric: with momentum no proof says that outputs come to rest");
  return end;
}

} // namespace hopmesh::networks
