#include "sim/run/array_info.h"

#include "rtl_model/spec/array_keys.h"
#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/memory_map.h"
#include "sim/input/count_text.h"
#include "sim/machine/silicon.h"
#include "sim/run/design/array_cost.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::run {

using input::grouped;

namespace {

std::string normaliser_text(const spec::ArraySpec& array) {
  if (array.output == spec::Output::binary) return "none: only the sign of s counts";
  const std::string name(name_of(array.normaliser));
  return spec::has_reciprocal(array) ? fmt::format("{}, {} bits", name, array.reciprocal_bits) : name;
}

std::string elements_text(const spec::ArraySpec& array) {
  if (!spec::is_folded(array)) return "one a neuron";
  return grouped(static_cast<std::uint64_t>(array.elements)) + ", shared by the neurons of a phase";
}

/// Of the sums; output stages have theirs.
std::string multipliers_text(const spec::ArraySpec& array, const spec::Topology& t) {
  return fmt::format("{} {}, {} in all", array.lanes, spec::is_folded(array) ? "an element" : "a neuron",
                     grouped(machine::parts_of(array, t).multipliers));
}

std::string stage_text(const spec::ArraySpec& array) {
  std::string text(name_of(array.output));
  if (array.output == spec::Output::projected) text += fmt::format(", omega {}", array.relaxation / 16.0);
  if (spec::has_momentum(array)) text += fmt::format(", a table of {} m", array.momentum_entries);
  if (spec::is_folded(array)) text += spec::shares_stage(array) ? ", one for all" : ", one an element";
  if (array.pipeline > 0)
    text += fmt::format(", {} of pipeline",
                        input::with_noun(static_cast<std::uint64_t>(array.pipeline), "register"));
  return text;
}

pictures::Figure& find_row(std::vector<pictures::Figure>& rows, const std::string& name) {
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const pictures::Figure& row) { return row.name == name; });
}

FigureTable shape(const levels::BuiltMesh& mesh, const spec::ArraySpec& array, const spec::Phases& phases) {
  const spec::Topology& t = mesh.topology();
  std::vector<pictures::Figure> rows{
      {"name", array.name},
      {"nodes", grouped(mesh.nodes())},
      {"cells (free nodes)", grouped(t.cells())},
      {"neurons", fmt::format("{} ({} a cell)", grouped(t.neurons()), t.neurons_per_cell)},
      {"links between cells", grouped(t.links())},
      {"inputs of a neuron", fmt::format("at most {}", t.most_taps())},
      {"elements", elements_text(array)},
      {"multipliers", multipliers_text(array, t)},
      {"output stage", stage_text(array)},
      {"normaliser", normaliser_text(array)},
      {"schedule", fmt::format("{}, {} phases a sweep", name_of(array.schedule), grouped(phases.size()))},
      {"host bus", fmt::format("{} bits", array.bus_bits)},
      {"clock", fmt::format("{} MHz", array.clock_mhz)},
  };
  if (array.schedule == spec::Schedule::coloured)
    find_row(rows, "schedule").value +=
        " (" + input::with_noun(phases.size() / t.neurons_per_cell, "colour") + ")";
  return {"Array", rows};
}

FigureTable formats(const levels::BuiltMesh& mesh, spec::ArraySpec array) {
  std::vector<pictures::Figure> rows;
  const std::string sum = spec::accumulator_format(array, mesh.topology().most_taps()).text();
  for (const spec::ArrayKey& key : spec::format_keys(array)) {
    const bool exact = key.value() == "exact";
    rows.push_back({key.word(), exact ? sum + " (exact)" : key.value()});
  }
  return {"Formats", rows};
}

std::string phase_text(const spec::ArraySpec& array, const spec::Topology& t, const spec::Phases& phases,
                       const spec::CycleModel& m) {
  const auto longest = std::max_element(m.phase.begin(), m.phase.end());
  if (spec::is_folded(array)) {
    const auto phase = static_cast<std::size_t>(longest - m.phase.begin());
    const std::size_t rounds = spec::fold_of(array, t, phases).rounds[phase].size();
    return fmt::format("{}, in {} of at most {} to accumulate, output stage of {}", *longest,
                       input::with_noun(rounds, "round"), spec::accumulate_cycles(array, t.most_taps()),
                       spec::stage_cycles(array));
  }
  std::string text = fmt::format("{} = {} accumulate + {} normalise + {} output", *longest,
                                 spec::accumulate_cycles(array, t.most_taps()), spec::normalise_cycles(array),
                                 spec::output_cycles(array));
  if (array.pipeline > 0) text += fmt::format(" + {} pipeline", array.pipeline);
  return text;
}

FigureTable cycles(const levels::BuiltMesh& mesh, const spec::ArraySpec& array, const spec::Phases& phases) {
  const spec::Topology& t = mesh.topology();
  const spec::CycleModel m = spec::cycle_model(array, t, phases);
  const spec::MemoryMap map = spec::memory_map(array, t);
  std::uint64_t load = 0;
  for (const spec::Window w : {spec::Window::WEIGHT, spec::Window::BIAS, spec::Window::OUTPUT})
    load += spec::bus_cycles(array, map[w].words());
  return {"Cycles",
          {{"longest phase", phase_text(array, t, phases, m)},
           {"sweep", grouped(m.sweep)},
           {"prepare, once a run", grouped(m.prepare)},
           {"run of n sweeps", fmt::format("{} + {} n", grouped(1 + m.prepare), grouped(m.sweep))},
           {"time of a sweep", fmt::format("{:.3g} us", static_cast<double>(m.sweep) / array.clock_mhz)},
           {"load weights, bias, start", grouped(load) + " on the bus"},
           {"RESET", grouped(spec::reset_cycles(array, t))}}};
}

/// A window's words, and why they hold one code each where they could hold more.
std::string window_text(const spec::ArraySpec& array, const spec::MemoryWindow& window, int code_bits) {
  std::string text = fmt::format("{} words at {:#x}", grouped(window.words()), window.offset);
  if (window.codes_a_word > 1) return text + fmt::format(", {} codes each", window.codes_a_word);
  if (array.packing) text += fmt::format(", one code each: {} bits are more than half a word", code_bits);
  return text;
}

FigureTable bus(const levels::BuiltMesh& mesh, const spec::ArraySpec& array) {
  const spec::MemoryMap map = spec::memory_map(array, mesh.topology());
  const spec::Formats& f = array.formats;
  FigureTable table{"Bus",
                    {{"registers and windows", fmt::format("{} KiB", grouped(map.span / 1024))},
                     {"window WEIGHT", window_text(array, map[spec::Window::WEIGHT], f.weight.width)},
                     {"window BIAS", window_text(array, map[spec::Window::BIAS], f.bias.width)},
                     {"window OUTPUT", window_text(array, map[spec::Window::OUTPUT], f.state.width)}}};
  if (spec::has_momentum(array))
    table.second.push_back(
        {"window MOMENTUM", window_text(array, map[spec::Window::MOMENTUM], spec::momentum_format.width)});
  return table;
}

std::string formulation(const scene::Scene& scene) {
  if (scene.motion.formulation == scene::Formulation::probe) return "probe: outputs are directions";
  return "incremental, " + name_of(scene.incremental.rule) +
         (scene.is_static() ? ": outputs are scaled ways towards rest"
                            : ": outputs are scaled changes of acceleration");
}

std::string start_text(const scene::Start& start) {
  const std::string place = start.shuffle > 0
                                ? fmt::format("up to {} m off its place, seed {}", start.shuffle, start.seed)
                                : "as built";
  const scene::Vector3& v = start.velocity;
  if (v == scene::Vector3{0, 0, 0}) return place + ", at rest";
  return place + fmt::format(", at ({}, {}, {}) m/s", v[0], v[1], v[2]);
}

std::string rest_text(const scene::RelaxSpec& relax) {
  return relax.stop == scene::Stop::sum
             ? fmt::format("no free neuron's |s| is above {} of the first sweep's largest", relax.share)
             : fmt::format("no output moves by more than {}", relax.threshold);
}

FigureTable motion(const scene::Scene& scene) {
  return {"Motion",
          {{"formulation", formulation(scene)},
           {"steps", fmt::format("{} of {} s", grouped(static_cast<std::uint64_t>(scene.motion.steps)),
                                 scene.motion.time_step)},
           {"start", start_text(scene.mesh.start)},
           {"expansions a step", fmt::format("{}", scene.relax.expansions)},
           {"relaxed until", fmt::format("{}, at most {} sweeps", rest_text(scene.relax),
                                         grouped(static_cast<std::uint64_t>(scene.relax.max_sweeps)))}}};
}

/// What values of keys leave out, as the table has it.
std::vector<pictures::Figure> values_left_out(scene::Scene scene) {
  std::vector<pictures::Figure> rows;
  for (const input::Key& key : scene_keys(scene))
    if (key.when.holds && input::is_left_out(key)) rows.push_back({key.left_out.what, key.left_out.words});
  return rows;
}

std::vector<pictures::Figure> terms_left_out(const scene::Scene& scene) {
  if (scene.motion.formulation == scene::Formulation::probe)
    return {{"inertia", "mass moves no node in the probe"}};
  if (scene.is_static()) return {{"inertia, speed", "static: each step minimises springs and weight alone"}};
  std::vector<pictures::Figure> rows{{"unit-length term", "the probe's: inertia stands in its place"}};
  if (scene.motion.friction == 0) rows.push_back({"velocity", "friction 0: each step starts from rest"});
  return rows;
}

FigureTable left_out(const scene::Scene& scene, const levels::BuiltMesh& mesh) {
  const std::size_t pinned = mesh.nodes() - mesh.cells(), n = mesh.components();
  std::vector<pictures::Figure> rows;
  if (pinned)
    rows.push_back(
        {"pinned nodes", fmt::format("{}: no cell, {} neurons fewer", grouped(pinned), grouped(pinned * n))});
  else
    rows.push_back({"pins", "none given: every node has a cell"});
  std::size_t to_pinned = 0, among_pinned = 0;
  for (const auto& s : mesh.mesh().springs) {
    const int ends = mesh.mesh().pinned[s.node[0]] + mesh.mesh().pinned[s.node[1]];
    to_pinned += ends == 1;
    among_pinned += ends == 2;
  }
  if (to_pinned)
    rows.push_back({"springs to pinned nodes", fmt::format("{}: in the bias, no link", grouped(to_pinned))});
  if (among_pinned)
    rows.push_back({"springs between pinned nodes", fmt::format("{}: no link", grouped(among_pinned))});
  if (n == 2) rows.push_back({"third neuron of a cell", "planar: y never moves"});
  for (const pictures::Figure& row : values_left_out(scene)) rows.push_back(row);
  for (const pictures::Figure& row : terms_left_out(scene)) rows.push_back(row);
  return {"Left out", rows};
}

} // namespace

std::vector<FigureTable> array_info(const scene::Scene& scene, const levels::BuiltMesh& mesh,
                                    const spec::ArraySpec& array, const StepLoad& step) {
  const spec::Topology& t = mesh.topology();
  const spec::Phases phases = spec::phases_of(t, array.schedule);
  return {motion(scene),
          shape(mesh, array, phases),
          formats(mesh, array),
          cycles(mesh, array, phases),
          step_time_table(array, t, step),
          bus(mesh, array),
          memory_table(array, t),
          multiplier_table(array, t),
          cost_table(array, t, step),
          left_out(scene, mesh)};
}

std::string text_of(const std::vector<FigureTable>& tables) {
  std::string text;
  for (const auto& [title, rows] : tables) {
    text += title + "\n";
    for (const auto& row : rows) text += fmt::format("  {:<28} {}\n", row.name, row.value);
  }
  return text;
}

} // namespace hopmesh::run
