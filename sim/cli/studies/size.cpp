// hopmesh size: the least array that meets an error on a scene, and what shows that it is.
#include "sim/cli/options.h"
#include "sim/cli/usage.h"
#include "sim/files/csv.h"
#include "sim/files/running_check.h"
#include "sim/input/count_text.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/array_info.h"
#include "sim/run/run_totals.h"
#include "sim/study/size_search.h"
#include "sim/study/truth_store.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace hopmesh::cli {

namespace {

namespace fs = std::filesystem;
using study::Setting;

constexpr const char* truth = "truth";

/// What --against may name: the level that judges all others, or the truth.
std::vector<std::string> judges() {
  return {levels::level_names({levels::Kind::reference}).front(), truth};
}

struct SizeOptions {
  CommonOptions common;
  double error = 0, time_per_step = 0;
  std::string against = judges().front(), out;
  std::int64_t steps = 0, workers = 0;
};

// Rounding may keep an array from rest for ever, so that every step ends by max_sweeps: such an array is
// small only at first sight. So much longer than double may an array relax.
constexpr double most_sweeps = 1.1;

/// Where the motion should end, and how near double itself comes to that.
struct Target {
  run::Positions positions;
  std::uint64_t sweeps = 0; ///< of the reference, in all
  double reached = 0, floor = 0;
  std::string trouble;
};

Target target_of(const SizeOptions& o, const levels::Prepared& p, const fs::path& folder) {
  const scene::MotionKeys& motion = p.inputs.scene.motion;
  levels::ReferenceMover reference(p.inputs.scene, *p.mesh, p.inputs.array);
  run::Progress progress(static_cast<std::uint64_t>(motion.steps));
  const run::RunResult result =
      run::simulate(reference, static_cast<std::uint64_t>(motion.steps), {&progress}, levels::stop_requested);
  if (result.outcome == run::Outcome::interrupted) throw study::SearchStopped();
  Target target;
  target.positions = reference.positions();
  target.sweeps = run::count_of(result.rows, &levels::StepRow::sweeps, levels::Summary::sum);
  if (result.outcome == run::Outcome::diverged) target.trouble = "the reference: " + result.sentence;
  if (o.against != truth || !target.trouble.empty()) return target;
  const double end = motion.time_step * static_cast<double>(motion.steps);
  const study::Truth exact = study::TruthStore(folder).at(p.inputs, *p.mesh, {end});
  if (exact.positions.empty()) {
    target.trouble = "SUNDIALS gave up: there is no truth to measure against";
    return target;
  }
  target.reached = run::rms_distance(target.positions, exact.positions[0]);
  target.floor = exact.floor[0];
  target.positions = exact.positions[0];
  return target;
}

// Ranges are of values: the array as given shows them.
std::vector<levels::SignalRange> ranges_of(const levels::Prepared& p) {
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p);
  run::simulate(*level.mover, static_cast<std::uint64_t>(p.inputs.scene.motion.steps), {},
                levels::stop_requested);
  if (levels::stop_requested) throw study::SearchStopped();
  return level.mover->ranges();
}

std::uint64_t hash_of(const SizeOptions& o, const levels::Prepared& p) {
  files::RunningCheck check;
  for (const std::string& text :
       {o.against, scene::scene_text(p.inputs.scene), input::array_text(p.inputs.array)})
    check.add(text.data(), text.size() + 1);
  return check.value();
}

std::string command_of(const SizeOptions& o, const study::Sizing& sizing, const Setting& setting) {
  CommonOptions common = o.common;
  if (o.steps > 0) common.overrides.push_back(fmt::format("motion.steps={}", o.steps));
  for (const std::string& word : sizing.overrides(setting)) common.overrides.push_back(word);
  return "hopmesh run " + words_of(common);
}

/// The scene with the array file: what was said of the array lies in it.
std::string file_command(const SizeOptions& o, const fs::path& folder) {
  CommonOptions common = o.common;
  common.array = (folder / "size.toml").string();
  auto& words = common.overrides;
  words.erase(std::remove_if(words.begin(), words.end(), input::is_array_key), words.end());
  return "hopmesh run " + words_of(common) + (o.steps > 0 ? fmt::format(" --steps {}", o.steps) : "");
}

void write_evidence(const fs::path& file, const SizeOptions& o, const levels::Prepared& p,
                    const study::Sizing& sizing, const study::SizeFound& found) {
  std::vector<std::string> columns{"what", "knob"};
  columns.insert(columns.end(), std::begin(study::knob_names), std::end(study::knob_names));
  for (const char* name : {"memory_bits", "multiplier_bits", "status", "error", "fails_by", "sweeps",
                           "cycles", "slowest_step", "command"})
    columns.emplace_back(name);
  files::CsvWriter table(file, columns);
  for (const study::SizeEvidence& e : found.evidence) {
    table.cell(e.what).cell(e.knob);
    for (std::size_t knob = 0; knob < study::knob_count; ++knob) table.cell(sizing.text_of(e.setting, knob));
    const spec::ArraySpec array = sizing.array_of(e.setting);
    table.cell(run::memory_bits(*p.mesh, array).total()).cell(run::multiplier_bits(*p.mesh, array));
    table.cell(name_of(e.row.outcome))
        .cell(e.row.error)
        .cell(e.fails_by)
        .cell(e.row.sweeps)
        .cell(e.row.cycles);
    table.cell(static_cast<double>(e.row.most_cycles) / (array.clock_mhz * 1e6));
    table.cell(command_of(o, sizing, e.setting)).end_row();
  }
  table.commit();
}

std::string relaxation_words(const study::Sizing& sizing, const study::SizeFound& found) {
  std::string words;
  for (std::size_t knob : {study::k_threshold, study::k_sweeps})
    if (found.setting[knob] != found.file[knob])
      words += fmt::format(" --set {}={}", study::knob_names[knob], sizing.text_of(found.setting, knob));
  return words;
}

void write_array(const fs::path& file, const SizeOptions& o, const study::Sizing& sizing,
                 const study::SizeFound& found) {
  files::write_file(
      file, fmt::format("# The least array found for {} at {} m rms from the {}. With its own sweeps:{}\n{}",
                        o.common.scene, o.error, o.against, relaxation_words(sizing, found),
                        input::array_text(sizing.array_of(found.setting))));
}

/// The row of the evidence about a knob.
const study::SizeEvidence* less(const study::SizeFound& found, const char* what, const std::string& knob) {
  for (const study::SizeEvidence& e : found.evidence)
    if (e.what == what && e.knob == knob) return &e;
  return nullptr;
}

void print_knobs(const study::Sizing& sizing, const study::SizeFound& found) {
  fmt::print("  {:<22} {:<28} {:>24} {:>24}\n", "", "least", "one less: m (fails by)",
             "two less: m (fails by)");
  const bool reciprocal = sizing.array_of(found.setting).normaliser == spec::Normaliser::reciprocal;
  for (std::size_t knob = 0; knob < study::k_lanes; ++knob) {
    if (knob == study::k_reciprocal && !reciprocal) continue;
    fmt::print("  {:<22} {:<28}", study::knob_names[knob], sizing.text_of(found.setting, knob));
    for (const char* what : {"one less", "two less"}) {
      const study::SizeEvidence* e = less(found, what, study::knob_names[knob]);
      fmt::print(" {:>24}", !e ? "at its least"
                            : e->row.outcome != run::Outcome::finished
                                ? std::string(name_of(e->row.outcome))
                                : fmt::format("{:.3g} ({})", e->row.error, e->fails_by));
    }
    fmt::print("\n");
  }
}

void print_lanes(const SizeOptions& o, const levels::Prepared& p, const study::Sizing& sizing,
                 const study::SizeFound& found) {
  fmt::print("Lanes: {}, {}\n", found.setting[study::k_lanes],
             o.time_per_step > 0 ? fmt::format("the fewest that do the slowest step in {} s", o.time_per_step)
                                 : std::string("where silicon times cycles is least"));
  for (const study::SizeEvidence& e : found.evidence) {
    if (e.what != "lanes") continue;
    const spec::ArraySpec array = sizing.array_of(e.setting);
    fmt::print("  {:>3} lanes {:>14} cycles {:>12.3g} s the slowest step {:>14} silicon bits\n", array.lanes,
               input::grouped(e.row.cycles), static_cast<double>(e.row.most_cycles) / (array.clock_mhz * 1e6),
               input::grouped(static_cast<std::uint64_t>(sizing.silicon_bits(e.setting))));
  }
  for (const spec::ArraySpec& array : {p.inputs.array, sizing.array_of(found.setting)})
    fmt::print("  {:<12} {:>12} memory bits {:>12} multiplier bits\n", array.name,
               input::grouped(run::memory_bits(*p.mesh, array).total()),
               input::grouped(run::multiplier_bits(*p.mesh, array)));
}

void print(const SizeOptions& o, const levels::Prepared& p, const study::Sizing& sizing, const Target& target,
           const study::SizeFound& found, const fs::path& folder) {
  const study::SizeEvidence &size = found.evidence[0], &file = found.evidence[1];
  fmt::print("{}: at most {} m rms from the {} after {}\n", p.inputs.scene.name, o.error, o.against,
             input::with_noun(static_cast<std::uint64_t>(p.inputs.scene.motion.steps), "step"));
  if (o.against == truth)
    fmt::print("The reference itself ends {:.3g} m from the truth, which is known to {:.1g} m\n",
               target.reached, target.floor);
  print_knobs(sizing, found);
  print_lanes(o, p, sizing, found);
  fmt::print("Formats tried: {}; {} met the error, {} of them with less silicon than this\n", found.tried,
             found.met, found.cheaper);
  const std::string command = file_command(o, folder);
  fmt::print("With the scene's relaxation: {:.3g} m, {}\n  {}\n", file.row.error,
             input::with_noun(file.row.sweeps, "sweep"), command);
  fmt::print("With the least of its own: {:.3g} m, {}\n  {}{}\n", size.row.error,
             input::with_noun(size.row.sweeps, "sweep"), command, relaxation_words(sizing, found));
  fmt::print("Results\n  {}\n  {}\n", (folder / "size.toml").string(), (folder / "size.csv").string());
}

int search(const SizeOptions& o, const levels::Prepared& p, const fs::path& folder,
           const study::TrialFolder& kept) {
  const Target target = target_of(o, p, folder);
  if (!target.trouble.empty() || o.error < target.reached) {
    fmt::print("{}: {}\n", p.inputs.scene.name,
               !target.trouble.empty()
                   ? target.trouble
                   : fmt::format("{} m is less than double itself reaches: the reference ends "
                                 "{:.3g} m from the truth",
                                 o.error, target.reached));
    return differs;
  }
  study::Sizing sizing(p.inputs, *p.mesh);
  sizing.keep_integer_bits(ranges_of(p));
  const std::size_t workers =
      o.workers > 0 ? static_cast<std::size_t>(o.workers) : std::max(1u, std::thread::hardware_concurrency());
  study::SizeTrials trials(sizing, kept, target.positions, workers);
  const auto sweeps = static_cast<std::uint64_t>(most_sweeps * static_cast<double>(target.sweeps));
  const study::SizeGoal goal{o.error, o.time_per_step, sweeps, p.inputs.array.clock_mhz,
                             p.mesh->topology().most_taps()};
  const study::SizeFound found = study::find_size(sizing, goal, trials);
  if (!found.reached) {
    fmt::print("{}: {}\n", p.inputs.scene.name, found.why);
    return differs;
  }
  write_array(folder / "size.toml", o, sizing, found);
  write_evidence(folder / "size.csv", o, p, sizing, found);
  print(o, p, sizing, target, found, folder);
  return done;
}

int size(const SizeOptions& o) {
  levels::catch_interrupts();
  levels::Prepared p = prepare(o.common);
  if (o.steps > 0) p.inputs.scene.motion.steps = o.steps;
  const study::Sizing checked(p.inputs, *p.mesh); // refuses before anything is written
  if (o.against == truth) study::TruthStore::expect_known(p.inputs.scene);
  const fs::path folder = o.out.empty() ? default_folder(p.inputs.scene.name + "-size") : o.out;
  const study::TrialFolder kept(folder, hash_of(o, p));
  try {
    return search(o, p, folder, kept);
  } catch (const study::SearchStopped&) {
    fmt::print("{}: stopped; what was tried is safe in {}, and the same command goes on\n",
               p.inputs.scene.name, folder.string());
    return interrupted;
  }
}

} // namespace

void add_size(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<SizeOptions>();
  CLI::App* verb = program.add_subcommand("size", "the least array that meets an error, with the evidence");
  add_common(*verb, o->common);
  verb->add_option("--error", o->error, "rms of positions at the end, m")
      ->required()
      ->check(positive_number());
  verb->add_option("--against", o->against, "reference (its free motion), or truth")
      ->check(one_name_of(judges()))
      ->capture_default_str();
  verb->add_option(
          "--time-per-step", o->time_per_step,
          "s: the fewest lanes that do the slowest step in so long (else: least silicon times cycles)")
      ->check(positive_number());
  verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--out", o->out,
                   "results folder (out/NAME-size): size.toml, size.csv; one that is there is gone on with");
  verb->add_option("-j", o->workers, "so many trials at a time (as many as processors); changes no result")
      ->check(whole_number(1, 1024));
  verb->footer(
      "Example:\n  hopmesh size two-nodes --error 0.001 --out out/two-nodes-size\n"
      "Exit: 0 done, 1 no array reaches the error or the time, 2 bad input, 130 interrupted (the same "
      "command goes on).");
  verb->callback([o, &exit_code] { exit_code = size(*o); });
}

} // namespace hopmesh::cli
