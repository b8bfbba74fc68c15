#include "sim/run/simulation.h"

#include "sim/levels/processor_time.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace hopmesh::run {

namespace {

// Sentences for people: one step is not "1 steps".
std::string all_done(std::uint64_t steps) {
  return steps == 1 ? "The one step is done." : fmt::format("All {} steps done.", steps);
}

std::string saved_steps_text(std::uint64_t before) {
  if (before == 0) return "No step was done before it.";
  return before == 1 ? "The one step before it is kept."
                     : fmt::format("The {} steps before it are kept.", before);
}

// A step; true while the run goes on.
bool one_step(levels::Mover& motion, std::uint64_t steps, const std::vector<StepSink*>& sinks,
              RunResult& result) {
  const std::uint64_t step = result.rows.size();
  try {
    result.rows.push_back(motion.advance());
  } catch (const levels::LostMotion& why) {
    result.outcome = Outcome::diverged;
    result.sentence =
        fmt::format("The motion diverged in step {}: {}. {}", step, why.what(), saved_steps_text(step));
    return false;
  } catch (const levels::Stopped&) {
    result.outcome = Outcome::interrupted;
    return false;
  }
  const levels::StepRow& row = result.rows.back();
  for (StepSink* sink : sinks) sink->step(row, motion);
  if (row.max_stretch < most_stretch) return true;
  result.outcome = Outcome::diverged;
  result.sentence = fmt::format("The motion diverged in step {} of {}: a spring is {:.3g} times its length "
                                "(the limit is {:g}). All steps so far are kept.",
                                step, steps, row.max_stretch, most_stretch);
  return false;
}

} // namespace

RunResult simulate(levels::Mover& motion, std::uint64_t steps, const std::vector<StepSink*>& sinks,
                   const std::atomic<bool>& stop, RunResult earlier) {
  using Wall = std::chrono::steady_clock;
  const auto began = Wall::now();
  const double used_before = levels::processor_seconds();
  RunResult result = std::move(earlier);
  result.sentence = all_done(steps);
  while (result.rows.size() < steps) {
    if (stop) result.outcome = Outcome::interrupted;
    if (stop || !one_step(motion, steps, sinks, result)) break;
  }
  if (result.outcome == Outcome::interrupted)
    result.sentence = fmt::format("Interrupted after {} of {} steps; their results are complete.",
                                  result.rows.size(), steps);
  if (const std::string unrest = unrest_text(result.rows); !unrest.empty()) result.sentence += " " + unrest;
  result.wall_seconds += std::chrono::duration<double>(Wall::now() - began).count();
  result.processor_seconds = levels::processor_seconds() - used_before;
  return result;
}

} // namespace hopmesh::run
