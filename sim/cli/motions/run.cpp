// hopmesh run: one simulation, its files and its figures.
#include "sim/cli/options.h"
#include "sim/input/standard_streams.h"
#include "sim/levels/interrupt.h"
#include "sim/run/flight.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct RunOptions {
  input::InputWords words;
  std::string level = levels::default_level().name, host, out, wave_window, wave_cells;
  levels::WaveRequest wave;
  std::int64_t steps = 0, threads = 1;
  bool check = false, no_check = false;
  std::string resume;
  std::int64_t checkpoint_every = 0;
};

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

run::FlightPlan plan_of(const RunOptions& o) {
  run::FlightPlan plan;
  plan.steps = o.steps, plan.every = static_cast<std::uint64_t>(o.checkpoint_every);
  plan.port.engine.threads = static_cast<std::size_t>(o.threads);
  plan.port.remarks = true;
  return plan;
}

// A key like others, so that manifest, studies and checkpoints know it.
input::InputWords with_host(input::InputWords words, const std::string& host) {
  if (!host.empty()) words.overrides.push_back("host.processor=" + host);
  return words;
}

// In the command that repeats a run, where its files go is no part of it, and --steps stands for itself.
run::Flight first_flight(const RunOptions& o) {
  const levels::Level& level = levels::level_named(o.level, "--level");
  run::FlightPlan plan = plan_of(o);
  plan.level = &level, plan.port.wave = wave_of(o, level);
  plan.command = fmt::format("hopmesh run {} --level {}", text_of(with_host(o.words, o.host)), o.level);
  plan.check = o.check || (level.checked && !o.no_check);
  if (!o.host.empty() && !level.has_bus())
    throw input::input_error("", 0, "--host", "level " + o.level,
                             "a level of the array: only those have a host");
  levels::Prepared prepared = prepare(with_host(with_steps(o.words, o.steps), o.host));
  const auto folder = results_folder(o.out, prepared.inputs.scene.name);
  return {std::move(prepared), folder, plan};
}

run::Flight next_flight(const RunOptions& o) {
  run::ResumedRun found = run::read_run(o.resume);
  const std::uint64_t steps_done = found.saved.state.step;
  if (o.steps > 0 && static_cast<std::uint64_t>(o.steps) <= steps_done)
    throw input::input_error("", 0, "--steps", std::to_string(o.steps),
                             fmt::format("more than the {} that are done", steps_done));
  return {std::move(found), o.resume, plan_of(o)};
}

int run(const RunOptions& o) {
  levels::catch_interrupts(); // from here on a run that is stopped leaves a folder to go on with
  run::Flight flight = o.resume.empty() ? first_flight(o) : next_flight(o);
  const run::RunResult result = flight.fly();
  fmt::print("{}", flight.text_of(result));
  const std::string trouble = flight.trouble();
  if (trouble.empty()) return exit_of(result.outcome);
  input::say(fmt::format("hopmesh: {}\n", trouble));
  return bad_input;
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
  for (const char* told : {"SCENE", "--array", "--set", "--level", "--host", "--out", "--check", "--no-check",
                           "--wave", "--wave-window", "--wave-cells"})
    resume->excludes(verb.get_option(told));
}

} // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "one simulation");
  add_common(*verb, o->words);
  verb->add_option("--level", o->level,
                   fmt::format("{}, or a rival in double: {}",
                               fmt::join(levels::level_names(levels::sweeping), " | "),
                               fmt::join(levels::level_names({levels::Kind::rival}), " | ")))
      ->capture_default_str();
  verb->add_option(
      "--host", o->host,
      "native | rv32: who runs the firmware; rv32 counts instructions (host.processor, beside it "
      "host.core and others)");
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
