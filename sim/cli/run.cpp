// hopmesh run: one simulation, its files and its figures.
#include "sim/cli/options.h"
#include "sim/cli/progress.h"
#include "sim/study/array_info.h"
#include "sim/study/run_files.h"
#include "sim/study/run_picture.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct RunOptions {
  CommonOptions common;
  std::string level = "engine", out, wave_window, wave_cells;
  WaveRequest wave;
  std::int64_t steps = 0, threads = 1;
  bool check = false, no_check = false;
};

// The command that repeats a run; where its files go is no part of it.
std::string command_of(const RunOptions& o) {
  std::string command = "hopmesh run " + words_of(o.common) + " --level " + o.level;
  if (o.steps > 0) command += " --steps " + std::to_string(o.steps);
  return command;
}

// out/NAME; a slash in a name must not lead elsewhere.
std::string default_folder(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return "out/" + (name == "." || name == ".." ? "scene" : name);
}

WaveRequest wave_of(const RunOptions& o) {
  WaveRequest wave = o.wave;
  if (wave.file.empty() && !(o.wave_window.empty() && o.wave_cells.empty()))
    throw scene::input_error("", 0, o.wave_window.empty() ? "--wave-cells" : "--wave-window", "no --wave",
                             "--wave FILE.vcd");
  if (!wave.file.empty() && o.level == "reference")
    throw scene::input_error("", 0, "--wave", "level reference",
                             "a level of the array: only those have signals");
  if (!o.wave_window.empty()) parse_window(o.wave_window, wave);
  if (!o.wave_cells.empty()) wave.cells = parse_cells(o.wave_cells);
  return wave;
}

// The engine is for speed and has judges of its own; the reference beside every step costs many times its
// time.
bool asks_reference(const RunOptions& o) {
  return o.check || (o.level != "engine" && !o.no_check);
}

int run(RunOptions& o) {
  check_level(o.level, "--level");
  const PortRequest request{wave_of(o), {static_cast<std::size_t>(o.threads)}};
  if (o.steps > 0) o.common.overrides.push_back("motion.steps=" + std::to_string(o.steps));
  const Prepared p = prepare(o.common);
  if (o.steps > 0) o.common.overrides.pop_back();
  Level level = make_level(o.level, p, asks_reference(o), request);
  const study::RunFacts facts{p.inputs, o.level, level.array != nullptr, command_of(o)};
  const std::filesystem::path folder = o.out.empty() ? default_folder(p.inputs.scene.name) : o.out;
  study::RunFiles files(folder, facts, *p.mesh, *level.motion);

  study::RunResult result;
  {
    catch_interrupts();
    const auto steps = static_cast<std::uint64_t>(p.inputs.scene.motion.steps);
    Progress progress(steps);
    result = study::simulate(*level.motion, steps, {&files, &progress}, stop_requested);
  }
  if (level.port) level.port->finish();
  files.finish(result, *level.motion);
  fmt::print("{}: {}\n", p.inputs.scene.name, result.sentence);
  fmt::print("{}", study::text_of(study::run_tables(facts, *p.mesh, result, level.motion->ranges())));
  fmt::print("Results\n  {}\n", folder.string());
  const std::string trouble = level.port ? level.port->trouble() : "";
  if (!trouble.empty()) {
    fmt::print(stderr, "hopmesh: {}\n", trouble);
    return bad_input;
  }
  if (result.outcome == study::Outcome::interrupted) return interrupted;
  return result.outcome == study::Outcome::diverged ? differs : done;
}

} // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "one simulation");
  add_common(*verb, o->common);
  verb->add_option("--level", o->level,
                   "reference | engine | systemc | systemc-clock (every neuron woken at every clock)")
      ->capture_default_str();
  verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--out", o->out, "results folder (out/NAME of the scene)");
  auto* check = verb->add_flag("--check", o->check,
                               "ask the double reference beside every step (as all levels but engine do)");
  verb->add_flag("--no-check", o->no_check, "do not ask it")->excludes(check);
  verb->add_option("-j", o->threads,
                   "at most so many threads of the engine, fewer on small meshes; changes no result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  verb->add_option("--wave", o->wave.file, "FILE.vcd: every register of the array, clock by clock");
  verb->add_option("--wave-window", o->wave_window, "FROM:TO in steps or FROM:TOc in cycles: only this part");
  verb->add_option("--wave-cells", o->wave_cells, "only these cells, like 0,4,10-12");
  verb->footer(
      "Example:\n  hopmesh run two-nodes --level systemc --steps 5 --out out/first --wave out/first/wave.vcd "
      "--wave-window "
      "0:1\n"
      "Exit: 0 done, 1 the motion diverged, 2 bad input, 130 interrupted (results so far are complete).");
  verb->callback([o, &exit_code] { exit_code = run(*o); });
}

} // namespace hopmesh::cli
