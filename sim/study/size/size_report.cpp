#include "sim/study/size/size_report.h"

#include "sim/files/csv.h"
#include "sim/input/count_text.h"
#include "sim/machine/hardware_time.h"
#include "sim/machine/silicon.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

using input::grouped, input::with_noun;

std::string command_of(const SizeReport& r, const Setting& setting) {
  input::InputWords words = with_steps(r.order.words, r.order.steps);
  for (const std::string& word : r.sizing.overrides(setting)) words.overrides.push_back(word);
  return "hopmesh run " + text_of(words);
}

machine::HardwareTime time_of(const TrialRow& row) {
  return {row.cycles, row.bus_cycles};
}

double slowest_step(const TrialRow& row, const spec::ArraySpec& array) {
  return static_cast<double>(row.most_cycles) / (array.clock_mhz * 1e6);
}

void write_row(files::CsvWriter& table, const SizeReport& r, const SizeEvidence& e) {
  table.cell(e.what).cell(e.knob);
  for (std::size_t knob = 0; knob < knob_count; ++knob) table.cell(r.sizing.text_of(e.setting, knob));
  const spec::ArraySpec array = r.sizing.array_of(e.setting);
  table.cell(machine::memory_bits(array, r.prepared.mesh->topology()).total());
  table.cell(machine::multiplier_bits(array, r.prepared.mesh->topology()).total());
  table.cell(name_of(e.row.outcome)).cell(e.row.error).cell(e.fails_by).cell(e.row.sweeps).cell(e.row.cycles);
  table.cell(e.row.bus_cycles).cell(time_of(e.row).seconds(array.clock_mhz));
  table.cell(slowest_step(e.row, array));
  const auto bound = r.bounds.of(r.sizing.inputs_of(e.setting));
  table.cell(bound ? std::optional(bound->most) : std::nullopt);
  table.cell(!bound ? "" : bound->proved ? "proved" : "assumed");
  table.cell(command_of(r, e.setting)).end_row();
}

void write_evidence(const SizeReport& r) {
  std::vector<std::string> columns{"what", "knob"};
  columns.insert(columns.end(), knob_names.begin(), knob_names.end());
  for (const char* name :
       {"memory_bits", "multiplier_bits", "status", "error", "fails_by", "sweeps", "cycles", "bus_cycles",
        "hardware_seconds", "slowest_step", "step_bound", "bound_is", "command"})
    columns.emplace_back(name);
  files::CsvWriter table(r.folder / "size.csv", columns);
  for (const SizeEvidence& e : r.found.evidence) write_row(table, r, e);
  table.commit();
}

std::string relaxation_words(const SizeReport& r) {
  std::string words;
  for (std::size_t knob : {k_threshold, k_sweeps})
    if (r.found.setting[knob] != r.found.file[knob])
      words += fmt::format(" --set {}={}", knob_names[knob], r.sizing.text_of(r.found.setting, knob));
  return words;
}

/// The scene with the array file: what was said of the array lies in it.
std::string file_command(const SizeReport& r) {
  input::InputWords words = r.order.words;
  words.array = (r.folder / "size.toml").string();
  auto& set = words.overrides;
  set.erase(std::remove_if(set.begin(), set.end(), input::is_array_key), set.end());
  const std::int64_t steps = r.order.steps;
  return "hopmesh run " + text_of(words) + (steps > 0 ? fmt::format(" --steps {}", steps) : "");
}

/// How the array with a knob lowered does.
std::string less_text(const SizeReport& r, const char* what, const std::string& knob) {
  for (const SizeEvidence& e : r.found.evidence)
    if (e.what == what && e.knob == knob)
      return e.row.outcome == run::Outcome::finished ? fmt::format("{:.3g} ({})", e.row.error, e.fails_by)
                                                     : std::string(name_of(e.row.outcome));
  return "at its least";
}

std::string knob_lines(const SizeReport& r) {
  std::string lines = fmt::format("  {:<22} {:<28} {:>24} {:>24}\n", "", "least",
                                  "tried, one less (fails by)", "tried, two less (fails by)");
  const bool reciprocal = r.sizing.array_of(r.found.setting).normaliser == spec::Normaliser::reciprocal;
  for (std::size_t knob = 0; knob < k_lanes; ++knob) {
    if (knob == k_reciprocal && !reciprocal) continue;
    const std::string& name = knob_names[knob];
    lines += fmt::format("  {:<22} {:<28} {:>24} {:>24}\n", name, r.sizing.text_of(r.found.setting, knob),
                         less_text(r, "one less", name), less_text(r, "two less", name));
  }
  return lines;
}

/// What follows from the formats, and what only flying tells.
std::string known_lines(const SizeReport& r) {
  const auto bound = r.bounds.of(r.sizing.inputs_of(r.found.file));
  std::string text = "Tried: errors, sweeps and cycles, of this motion alone. Proved: silicon, by formula";
  if (!bound) return text + "; nothing bounds a step's positions here\n";
  text += fmt::format("; {}with the scene's relaxation a step's positions end within {:.3g} m rms of its own "
                      "network's answer (the largest of {} looked at)\n",
                      bound->proved ? "" : "unproved, if momentum slows down slowly, ", bound->most,
                      with_noun(r.bounds.looked_at(), "step"));
  if (r.start_level)
    text += fmt::format("The search began at {} behind every point, where that bound times the steps is the "
                        "error asked for\n",
                        with_noun(static_cast<std::uint64_t>(*r.start_level), "bit"));
  return text;
}

std::string lane_lines(const SizeReport& r) {
  std::string lines =
      fmt::format("Lanes: {}, {}\n", r.found.setting[k_lanes],
                  r.order.time_per_step > 0
                      ? fmt::format("the fewest that do the slowest step in {} s", r.order.time_per_step)
                      : std::string("where silicon times cycles, of array and bus together, is least"));
  for (const SizeEvidence& e : r.found.evidence) {
    if (e.what != "lanes") continue;
    const spec::ArraySpec array = r.sizing.array_of(e.setting);
    lines += fmt::format("  {:>8} {:>14} cycles {:>4.0f} % bus {:>12.3g} s the slowest step {:>14} "
                         "silicon bits\n",
                         with_noun(static_cast<std::uint64_t>(array.lanes), "lane"),
                         grouped(time_of(e.row).cycles()), 100 * time_of(e.row).bus_share(),
                         slowest_step(e.row, array),
                         grouped(static_cast<std::uint64_t>(r.sizing.silicon_bits(e.setting))));
  }
  return lines;
}

/// Like with like first: what the words save shows at equal lanes.
std::string silicon_lines(const SizeReport& r) {
  const spec::ArraySpec& given = r.prepared.inputs.array;
  std::vector<spec::ArraySpec> arrays(2, r.sizing.array_of(r.found.setting));
  arrays[0].lanes = given.lanes;
  arrays.insert(arrays.begin(), given);
  if (arrays[1].lanes == arrays[2].lanes) arrays.pop_back();
  std::string lines = "Silicon\n";
  for (const spec::ArraySpec& array : arrays)
    lines += fmt::format("  {:<12} {:>8} {:>14} memory bits {:>14} multiplier bits\n", array.name,
                         with_noun(static_cast<std::uint64_t>(array.lanes), "lane"),
                         grouped(machine::memory_bits(array, r.prepared.mesh->topology()).total()),
                         grouped(machine::multiplier_bits(array, r.prepared.mesh->topology()).total()));
  return lines;
}

/// Whether there was anything to be gained.
std::string given_line(const SizeReport& r) {
  const std::string& name = r.prepared.inputs.array.name;
  if (r.given.outcome != run::Outcome::finished)
    return fmt::format("The array as given, {}, {}\n", name, run::name_of(r.given.outcome));
  const bool near = r.given.error <= r.order.error, soon = r.given.sweeps <= r.most_sweeps;
  return fmt::format("The array as given, {}: {:.3g} m, {}: {}\n", name, r.given.error,
                     with_noun(r.given.sweeps, "sweep"),
                     near && soon ? "meets the error"
                     : near       ? fmt::format("takes more than {} sweeps", grouped(r.most_sweeps))
                                  : std::string("does not meet the error"));
}

} // namespace

void write_size(const SizeReport& r) {
  files::write_file(
      r.folder / "size.toml",
      fmt::format("# The least array found for {} at {} m rms from the {}. With its own sweeps:{}\n{}",
                  r.order.words.scene, r.order.error, r.order.against, relaxation_words(r),
                  input::array_text(r.sizing.array_of(r.found.setting))));
  write_evidence(r);
}

std::string text_of(const SizeReport& r) {
  const SizeEvidence &size = r.found.evidence[0], &file = r.found.evidence[1];
  const scene::Scene& scene = r.prepared.inputs.scene;
  std::string text =
      fmt::format("{}: at most {} m rms from the {} after {}\n", scene.name, r.order.error, r.order.against,
                  with_noun(static_cast<std::uint64_t>(scene.motion.steps), "step"));
  if (r.order.against == size_judges().back())
    text += fmt::format("The reference itself ends {:.3g} m from the truth, which is known to {:.1g} m\n",
                        r.reached, r.floor);
  text += fmt::format("Two references that start a last place apart end {:.2g} m apart\n", r.sensitivity);
  text += given_line(r) + knob_lines(r) + known_lines(r) + lane_lines(r) + silicon_lines(r);
  text += fmt::format("Formats tried: {}; {} met the error, {} of them with less silicon than this\n",
                      r.found.tried, r.found.met, r.found.cheaper);
  const std::string command = file_command(r);
  text += fmt::format("With the scene's relaxation: {:.3g} m, {}\n  {}\n", file.row.error,
                      with_noun(file.row.sweeps, "sweep"), command);
  text += fmt::format("With the least of its own: {:.3g} m, {}\n  {}{}\n", size.row.error,
                      with_noun(size.row.sweeps, "sweep"), command, relaxation_words(r));
  return text + fmt::format("Results\n  {}\n  {}\n", (r.folder / "size.toml").string(),
                            (r.folder / "size.csv").string());
}

} // namespace hopmesh::study
