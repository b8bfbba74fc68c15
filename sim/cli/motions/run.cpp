// hopmesh run: one simulation, its files and its figures.
#include "sim/cli/options.h"
#include "sim/files/output_file.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/array_info.h"
#include "sim/run/checkpointer.h"
#include "sim/run/progress.h"
#include "sim/run/run_picture.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct RunOptions {
  CommonOptions common;
  std::string level = levels::default_level().name, out, wave_window, wave_cells;
  levels::WaveRequest wave;
  std::int64_t steps = 0, threads = 1;
  bool check = false, no_check = false;
  std::string resume;
  std::int64_t checkpoint_every = 0;
};

// The command that repeats a run; where its files go is no part of it, and --steps stands for itself.
std::string command_of(const RunOptions& o) {
  return "hopmesh run " + words_of(o.common) + " --level " + o.level;
}

levels::WaveRequest wave_of(const RunOptions& o, const levels::Level& level) {
  levels::WaveRequest wave = o.wave;
  if (wave.file.empty() && !(o.wave_window.empty() && o.wave_cells.empty()))
    throw input::input_error("", 0, o.wave_window.empty() ? "--wave-cells" : "--wave-window", "no --wave",
                             "--wave FILE.vcd");
  if (!wave.file.empty() && !level.can_wave)
    throw input::input_error("", 0, "--wave", "level " + o.level,
                             "a level of the array: only those have signals");
  if (!o.wave_window.empty()) levels::parse_window(o.wave_window, wave);
  if (!o.wave_cells.empty()) wave.cells = levels::parse_cells(o.wave_cells);
  return wave;
}

levels::PortRequest request_of(const RunOptions& o) {
  levels::PortRequest request;
  request.engine.threads = static_cast<std::size_t>(o.threads);
  request.remarks = true;
  return request;
}

bool asks_reference(const RunOptions& o, const levels::Level& level) {
  return o.check || (level.checked && !o.no_check);
}

/// A run before its first step of this process, be it the very first or one behind a checkpoint.
struct Begun {
  levels::Prepared prepared;
  levels::ReadyLevel level;
  std::unique_ptr<run::RunFiles> files;
  run::RunResult earlier; ///< what was done before
  std::uint64_t every = 0;
};

Begun begin(RunOptions& o) {
  const levels::Level& level = levels::level_named(o.level, "--level");
  levels::PortRequest request = request_of(o);
  request.wave = wave_of(o, level);
  if (o.steps > 0) o.common.overrides.push_back("motion.steps=" + std::to_string(o.steps));
  Begun run{prepare(o.common), {}, {}, {}, static_cast<std::uint64_t>(o.checkpoint_every)};
  if (o.steps > 0) o.common.overrides.pop_back();
  const scene::Inputs& inputs = run.prepared.inputs;
  run.level = levels::make_ready(level, run.prepared, asks_reference(o, level), request);
  const run::RunFacts facts{inputs, &level, command_of(o), static_cast<std::uint64_t>(o.steps),
                            asks_reference(o, level)};
  const std::filesystem::path folder = o.out.empty() ? default_folder(inputs.scene.name) : o.out;
  run.files = std::make_unique<run::RunFiles>(folder, facts, *run.prepared.mesh, *run.level.mover);
  return run;
}

// The checkpoint knows the run; only its length, and what changes no bit, may be asked for anew.
Begun begin_again(const RunOptions& o) {
  run::ResumedRun found = run::read_run(o.resume);
  const run::Checkpoint& saved = found.saved;
  const auto steps = static_cast<std::uint64_t>(o.steps);
  if (steps > 0 && steps <= saved.state.step)
    throw input::input_error("", 0, "--steps", std::to_string(steps),
                             fmt::format("more than the {} that are done", saved.state.step));
  if (steps > 0) found.inputs.scene.motion.steps = o.steps;
  Begun run;
  run.every = o.checkpoint_every > 0 ? static_cast<std::uint64_t>(o.checkpoint_every) : saved.every;
  run.prepared = {std::move(found.inputs), std::move(found.mesh)};
  const levels::Level& level = levels::level_named(saved.level, saved.file);
  run.level = levels::make_ready(level, run.prepared, saved.check, request_of(o));
  run.level.mover->restore(saved.state, saved.ranges);
  run.earlier.rows = std::move(found.rows);
  run.earlier.wall_seconds = saved.wall_seconds;
  const run::RunFacts facts{run.prepared.inputs, &level, saved.command, steps > 0 ? steps : saved.asked,
                            saved.check};
  run.files = std::make_unique<run::RunFiles>(o.resume, facts, *run.prepared.mesh, std::move(found.streams));
  return run;
}

/// All steps that are left. `trouble`: why an interrupted run cannot be resumed where it ended, if so.
run::RunResult fly(Begun& run, std::string& trouble) {
  const auto steps = static_cast<std::uint64_t>(run.prepared.inputs.scene.motion.steps);
  const std::uint64_t before = run.earlier.rows.size();
  run::Progress progress(steps, before);
  run::Checkpointer safe(*run.files, run.every, run.earlier.wall_seconds, [&](std::uint64_t done) {
    if (run.every > 0) progress.say(fmt::format("checkpoint: {} of {} steps are safe", done, steps));
  });
  if (before > 0) progress.say(fmt::format("checkpoint: goes on behind {} of {} steps", before, steps));
  if (before == 0 && run.every > 0)
    safe.save(*run.level.mover); // a kill before the first K steps is resumable
  auto result = run::simulate(*run.level.mover, steps, {run.files.get(), &safe, &progress},
                              levels::stop_requested, run.earlier);
  try {
    if (result.outcome == run::Outcome::interrupted) safe.save(*run.level.mover);
  } catch (const files::WriteError& error) {
    trouble = error.what(); // the results may be small enough all the same
  }
  return result;
}

int run(RunOptions& o) {
  levels::catch_interrupts(); // from here on a run that is stopped leaves a folder to go on with
  Begun run = o.resume.empty() ? begin(o) : begin_again(o);
  std::string trouble;
  const run::RunResult result = fly(run, trouble);
  const levels::Mover& motion = *run.level.mover;
  const run::RunFacts& facts = run.files->facts();
  if (run.level.port) run.level.port->finish();
  run.files->finish(result, motion);
  fmt::print("{}: {}\n", facts.inputs.scene.name, result.sentence);
  fmt::print("{}", run::text_of(run::run_tables(facts, *run.prepared.mesh, result, motion.ranges())));
  const std::string folder = run.files->folder().string();
  fmt::print("Results\n  {}\n", folder);
  const bool stopped = result.outcome == run::Outcome::interrupted;
  if (stopped && trouble.empty()) fmt::print("To go on\n  hopmesh run --resume {}\n", shell_word(folder));
  if (trouble.empty() && run.level.port) trouble = run.level.port->trouble();
  if (!trouble.empty()) {
    fmt::print(stderr, "hopmesh: {}\n", trouble);
    return bad_input;
  }
  if (stopped) return interrupted;
  return result.outcome == run::Outcome::diverged ? differs : done;
}

void expect_scene_or_resume(const CLI::App& verb) {
  if (verb.count("SCENE") + verb.count("--resume") == 0) throw CLI::RequiredError("SCENE");
}

/// --resume beside what the checkpoint leaves open: --steps, --checkpoint-every, -j.
void allow_resume(CLI::App& verb, RunOptions& o) {
  verb.get_option("SCENE")->required(false);
  auto* resume =
      verb.add_option("--resume", o.resume,
                      "DIR: goes on with the run that was interrupted or killed there, bit for bit; "
                      "beside it only --steps (more than are done), --checkpoint-every and -j")
          ->group("Safety");
  for (const char* told : {"SCENE", "--array", "--set", "--level", "--out", "--check", "--no-check", "--wave",
                           "--wave-window", "--wave-cells"})
    resume->excludes(verb.get_option(told));
}

} // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "one simulation");
  add_common(*verb, o->common);
  verb->add_option("--level", o->level,
                   fmt::format("{}, or a rival in double: {}",
                               fmt::join(levels::level_names(levels::sweeping), " | "),
                               fmt::join(levels::level_names({levels::Kind::rival}), " | ")))
      ->capture_default_str();
  verb->add_option("--steps", o->steps, "steps to do, instead of the scene's")->check(whole_number(1));
  verb->add_option("--out", o->out, "results folder (out/NAME of the scene)");
  auto* check = verb->add_flag("--check", o->check,
                               "ask the double reference beside every step (as all levels but engine do)");
  verb->add_flag("--no-check", o->no_check, "do not ask it")->excludes(check);
  verb->add_option("-j", o->threads,
                   "at most so many threads of the engine, fewer on small meshes; changes no result")
      ->check(whole_number(1, 256))
      ->capture_default_str();
  verb->add_option("--wave", o->wave.file, "FILE.vcd: every register of the array, clock by clock")
      ->group("Wave");
  verb->add_option("--wave-window", o->wave_window, "FROM:TO in steps or FROM:TOc in cycles: only this part")
      ->group("Wave");
  verb->add_option("--wave-cells", o->wave_cells, "only these cells, like 0,4,10-12")->group("Wave");
  verb->add_option("--checkpoint-every", o->checkpoint_every,
                   "make the steps safe from a kill after every K of them")
      ->group("Safety")
      ->check(whole_number(1));
  allow_resume(*verb, *o);
  verb->footer(
      "Example:\n  hopmesh run two-nodes --level systemc --steps 5 --out out/first --wave out/first/wave.vcd "
      "--wave-window "
      "0:1\n"
      "Exit: 0 done, 1 the motion diverged, 2 bad input, 130 interrupted (results so far are complete, "
      "and --resume goes on).");
  verb->callback([verb, o, &exit_code] {
    expect_scene_or_resume(*verb);
    exit_code = run(*o);
  });
}

} // namespace hopmesh::cli
