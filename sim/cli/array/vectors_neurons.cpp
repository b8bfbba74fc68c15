// hopmesh vectors --neurons: firings of one neuron, written and judged.
#include "sim/cli/array/vectors_options.h"
#include "sim/cosim/firings/firing_judge.h"
#include "sim/cosim/firings/neuron_vectors.h"
#include "sim/input/array_file.h"
#include "sim/input/count_text.h"
#include "sim/input/toml_source.h"
#include "sim/levels/interrupt.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

using input::grouped;

constexpr std::int64_t usual_taps = 27; ///< of the longest row of a grid with diagonals, three neurons a cell

cosim::FiringFormat format_of(const std::string& name) {
  for (std::size_t k = 0; k < cosim::firing_format_names.size(); ++k)
    if (name == cosim::firing_format_names[k]) return static_cast<cosim::FiringFormat>(k);
  return cosim::FiringFormat::text;
}

spec::ArraySpec named_array(const VectorsOptions& o) {
  std::vector<std::pair<std::string, std::string>> overrides;
  for (const std::string& text : o.words.overrides) overrides.push_back(input::split_override(text));
  std::vector<std::string> notes;
  auto array = input::read_array(o.words.array, overrides, notes);
  tell(notes);
  return array;
}

} // namespace

void check_neuron_options(const VectorsOptions& o) {
  if (!o.neurons) {
    if (!o.format.empty()) refuse("--format", o.format + " without --neurons", "--neurons");
    if (o.taps > 0) refuse("--taps", std::to_string(o.taps) + " without --neurons", "--neurons --random N");
    return;
  }
  if (!o.format.empty()) {
    check_name(o.format, "--format", {cosim::firing_format_names.begin(), cosim::firing_format_names.end()});
    if (!o.check.empty()) refuse("--format", o.format + " beside --check", "none: the file says so");
  }
  if (o.taps > 0 && o.random == 0)
    refuse("--taps", std::to_string(o.taps) + " without --random", "--random N");
  check_name(o.level, "--level", cosim::open_levels());
}

int write_neurons(const VectorsOptions& o) {
  const levels::Level& level = levels::level_named(o.level, "--level");
  const cosim::FiringsWanted wanted{o.out, format_of(o.format), o.blank};
  cosim::FiringsWritten written;
  if (o.random > 0) {
    const auto taps = static_cast<std::size_t>(o.taps > 0 ? o.taps : usual_taps);
    written = cosim::write_random_firings(wanted, named_array(o), o.words.array, taps, o.seed,
                                          static_cast<std::uint64_t>(o.random), level);
  } else {
    const auto a_case = step_case(o);
    if (!a_case) return levels::stop_requested ? interrupted : differs;
    written = cosim::write_firings(wanted, *a_case, level);
  }
  if (written.interrupted) return interrupted;
  fmt::print("{}: {} firings on edges and {} others, {}\n", o.out, grouped(written.edges),
             grouped(written.others), o.blank ? "without answers" : "answers by level " + o.level);
  const std::string missing = cosim::missing_edges(written.shown);
  if (!missing.empty()) fmt::print("no firing of this array was found for {}\n", missing);
  return done;
}

int judge_neurons(const VectorsOptions& o) {
  const auto judged = cosim::judge_firings(o.check, levels::level_named(o.level, "--level"));
  if (judged.interrupted) return interrupted;
  if (!judged.wrong.empty()) {
    fmt::print("{}\n", judged.wrong);
    return differs;
  }
  fmt::print("{}: {} firings, all right in {} (level {})\n", o.check, grouped(judged.firings),
             fmt::join(judged.told, ", "), o.level);
  if (!judged.untold.empty()) fmt::print("not told, so not judged: {}\n", fmt::join(judged.untold, ", "));
  return done;
}

} // namespace hopmesh::cli
