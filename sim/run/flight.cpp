#include "sim/run/flight.h"

#include "sim/input/command_words.h"
#include "sim/levels/interrupt.h"
#include "sim/run/array_info.h"
#include "sim/run/checkpointer.h"
#include "sim/run/progress.h"
#include "sim/run/run_picture.h"
#include "sim/run/unrest.h"

#include <fmt/format.h>

namespace hopmesh::run {

namespace {

// The checkpoint knows the run; only its length, and what changes no bit, may be asked for anew.
levels::Prepared prepared_of(ResumedRun& found, std::int64_t steps) {
  if (steps > 0) found.inputs.scene.motion.steps = steps;
  return {std::move(found.inputs), std::move(found.mesh)};
}

levels::ReadyLevel level_behind(const Checkpoint& saved, const levels::Prepared& prepared,
                                const levels::PortRequest& port) {
  const levels::Level& level = levels::level_named(saved.level, saved.file);
  levels::ReadyLevel ready = levels::make_ready(level, prepared, saved.check, port);
  ready.mover->restore(saved.state, saved.ranges);
  return ready;
}

RunResult done_before(ResumedRun& found) {
  RunResult earlier;
  earlier.rows = std::move(found.rows);
  earlier.wall_seconds = found.saved.wall_seconds;
  return earlier;
}

} // namespace

Flight::Flight(levels::Prepared prepared, const std::filesystem::path& folder, const FlightPlan& plan)
    : prepared_(std::move(prepared)),
      level_(levels::make_ready(*plan.level, prepared_, plan.check, plan.port)), every_(plan.every),
      files_(folder,
             RunFacts{prepared_.inputs, plan.level, plan.command, static_cast<std::uint64_t>(plan.steps),
                      plan.check},
             *prepared_.mesh, *level_.mover) {}

Flight::Flight(ResumedRun found, const std::filesystem::path& folder, const FlightPlan& plan)
    : prepared_(prepared_of(found, plan.steps)), level_(level_behind(found.saved, prepared_, plan.port)),
      every_(plan.every > 0 ? plan.every : found.saved.every), earlier_(done_before(found)),
      files_(folder,
             RunFacts{prepared_.inputs, level_.level, found.saved.command,
                      plan.steps > 0 ? static_cast<std::uint64_t>(plan.steps) : found.saved.asked,
                      found.saved.check},
             *prepared_.mesh, std::move(found.streams)) {}

RunResult Flight::fly_steps() {
  const auto steps = static_cast<std::uint64_t>(prepared_.inputs.scene.motion.steps);
  const std::uint64_t before = earlier_.rows.size();
  Progress progress(steps, before);
  Checkpointer safe(files_, every_, earlier_.wall_seconds, [&](std::uint64_t done) {
    if (every_ > 0) progress.say(fmt::format("checkpoint: {} of {} steps are safe", done, steps));
  });
  if (before > 0) progress.say(fmt::format("checkpoint: goes on behind {} of {} steps", before, steps));
  if (before == 0 && every_ > 0) safe.save(*level_.mover); // a kill before the first K steps is resumable
  RunResult result =
      simulate(*level_.mover, steps, {&files_, &safe, &progress}, levels::stop_requested, earlier_);
  try {
    if (result.outcome == Outcome::interrupted) safe.save(*level_.mover);
  } catch (const files::WriteError& error) {
    unsafe_ = error.what(); // the results may be small enough all the same
  }
  return result;
}

RunResult Flight::fly() {
  RunResult result = fly_steps();
  if (level_.port) level_.port->finish();
  files_.finish(result, *level_.mover);
  return result;
}

std::string Flight::text_of(const RunResult& result) const {
  const auto tables = run_tables(files_.facts(), *prepared_.mesh, result, level_.mover->ranges());
  const std::string folder = files_.folder().string();
  std::string text = fmt::format("{}: {}\n{}Results\n  {}\n", prepared_.inputs.scene.name, result.sentence,
                                 run::text_of(tables), folder);
  if (result.outcome == Outcome::interrupted && unsafe_.empty())
    text += fmt::format("To go on\n  hopmesh run --resume {}\n", input::shell_word(folder));
  // Last, where it is seen: above, the tables push it out of a terminal.
  if (const std::string unrest = unrest_text(result.rows); !unrest.empty())
    text += "Not at rest: " + unrest + '\n';
  return text;
}

std::string Flight::trouble() const {
  if (unsafe_.empty() && level_.port) return level_.port->trouble();
  return unsafe_;
}

} // namespace hopmesh::run
