#include "sim/study/size/size.h"

#include "sim/files/running_check.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/run_totals.h"
#include "sim/study/size/size_report.h"
#include "sim/study/truth_store.h"
#include "sim/study/twin.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

constexpr const char* truth = "truth";

// Rounding may keep an array from rest for ever, so that every step ends by max_sweeps: such an array is
// small only at first sight. So much longer than double may an array relax.
constexpr double most_sweeps = 1.1;

/// Where the motion should end.
struct Target {
  run::Positions positions;
  std::uint64_t sweeps = 0;      ///< of the reference, in all
  double reached = 0, floor = 0; ///< how near double itself comes to the truth, and how far that is known, m
  double sensitivity = 0;        ///< of the motion to the last place of its start, m
  std::string trouble;           ///< why there is no target, if so
};

std::string decided_text(double error, double time, std::int64_t steps) {
  if (steps == 0) return fmt::format("{} m is not decided after a single step", error);
  return fmt::format("the longest time for which {} m is decided is {:.4g} s (--steps {})", error, time,
                     steps);
}

// An error that the last place of the start decides is met by luck or not at all.
void expect_decided(double error, const Twin& twin, double time_step) {
  const std::vector<double>& apart = twin.apart();
  if (apart.empty() || error >= apart.back()) return;
  const auto lost = std::find_if(apart.begin(), apart.end(), [&](double d) { return d > error; });
  const auto steps = lost - apart.begin();
  throw input::input_error(
      "", 0, "--error", fmt::format("{}", error),
      fmt::format("at least {:.3g}: so far apart, in m, end two references that start a last place apart; {}",
                  apart.back(), decided_text(error, static_cast<double>(steps) * time_step, steps)));
}

// The end of the reference's free motion, or of the exact one, which lies in the folder.
Target target_of(const SizeOrder& order, const levels::Prepared& p, const std::filesystem::path& folder,
                 levels::ReferenceMover& reference, StepBounds& bounds) {
  const scene::MotionKeys& motion = p.inputs.scene.motion;
  Twin twin(p.inputs.scene, *p.mesh, p.inputs.array);
  const run::RunResult result =
      run::simulate_shown(reference, static_cast<std::uint64_t>(motion.steps), {&twin, &bounds});
  if (result.outcome == run::Outcome::interrupted) throw SearchStopped();
  if (result.outcome == run::Outcome::finished) expect_decided(order.error, twin, motion.time_step);
  Target target;
  if (!twin.apart().empty()) target.sensitivity = twin.apart().back();
  target.positions = reference.positions();
  target.sweeps = run::count_of(result.rows, &levels::StepRow::sweeps, levels::Summary::sum);
  if (result.outcome == run::Outcome::diverged) target.trouble = "the reference: " + result.sentence;
  if (order.against != truth || !target.trouble.empty()) return target;
  const double end = motion.time_step * static_cast<double>(motion.steps);
  const Truth exact = TruthStore(folder).at(p.inputs, *p.mesh, {end});
  if (exact.positions.empty()) {
    target.trouble = "SUNDIALS gave up: there is no truth to measure against";
    return target;
  }
  target.reached = run::rms_distance(target.positions, exact.positions[0]);
  target.floor = exact.floor[0];
  target.positions = exact.positions[0];
  return target;
}

/// The array as given: its ranges, which are of values and so hold for all widths, and what it comes to.
struct Given {
  std::vector<levels::SignalRange> ranges;
  TrialRow row;
};

Given fly_given(const levels::Prepared& p, const Target& target) {
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p);
  const run::RunResult result = run::simulate(
      *level.mover, static_cast<std::uint64_t>(p.inputs.scene.motion.steps), {}, levels::stop_requested);
  if (levels::stop_requested) throw SearchStopped();
  return {level.mover->ranges(),
          trial_row(result, run::rms_distance(level.mover->positions(), target.positions))};
}

std::uint64_t hash_of(const SizeOrder& order, const levels::Prepared& p) {
  files::RunningCheck check;
  for (const std::string& text :
       {order.against, scene::scene_text(p.inputs.scene), input::array_text(p.inputs.array)})
    check.add(text.data(), text.size() + 1);
  return check.value();
}

/// "" where double itself comes as near as the order asks.
std::string why_not(const SizeOrder& order, const Target& target) {
  if (!target.trouble.empty()) return target.trouble;
  if (order.error >= target.reached) return "";
  return fmt::format("{} m is less than double itself reaches: the reference ends {:.3g} m from the truth",
                     order.error, target.reached);
}

// Errors of steps need not add up, nor stay what they were: so this is where to begin, and no answer.
std::optional<int> start_level(const SizeOrder& order, const Sizing& sizing, const StepBounds& bounds,
                               const scene::Inputs& inputs) {
  const double a_step =
      order.error / static_cast<double>(std::max<std::int64_t>(1, inputs.scene.motion.steps));
  const Setting widest = sizing.widest();
  const int top = *std::max_element(widest.begin(), widest.begin() + k_reciprocal);
  for (int level = 1; level < top; ++level) {
    Setting cut = widest;
    for (std::size_t knob = 0; knob <= k_reciprocal; ++knob)
      while (cut[knob] > level) {
        const auto lower = sizing.lowered(cut, knob, 1);
        if (!lower) break;
        cut = *lower;
      }
    const auto most = bounds.of(sizing.inputs_of(cut));
    if (most && most->most <= a_step) return level;
  }
  return std::nullopt;
}

SizeEnd search(const SizeOrder& order, const levels::Prepared& p, const std::filesystem::path& folder,
               const TrialFolder& kept) {
  const std::string& name = p.inputs.scene.name;
  levels::ReferenceMover reference(p.inputs.scene, *p.mesh, p.inputs.array);
  StepBounds bounds(reference, *p.mesh, p.inputs);
  const Target target = target_of(order, p, folder, reference, bounds);
  const std::string why = why_not(order, target);
  if (!why.empty()) return {run::Outcome::failed, fmt::format("{}: {}\n", name, why)};
  Sizing sizing(p.inputs, *p.mesh);
  const Given given = fly_given(p, target);
  sizing.keep_integer_bits(given.ranges);
  SizeTrials trials(sizing, kept, target.positions, order.workers);
  const auto sweeps = static_cast<std::uint64_t>(most_sweeps * static_cast<double>(target.sweeps));
  const SizeGoal goal{order.error,
                      order.time_per_step,
                      sweeps,
                      p.inputs.array.clock_mhz,
                      p.mesh->topology().most_taps(),
                      start_level(order, sizing, bounds, p.inputs)};
  const SizeFound found = find_size(sizing, goal, trials);
  if (!found.reached) return {run::Outcome::failed, fmt::format("{}: {}\n", name, found.why)};
  const SizeReport report{order,
                          p,
                          sizing,
                          found,
                          given.row,
                          folder,
                          target.reached,
                          target.floor,
                          target.sensitivity,
                          sweeps,
                          bounds,
                          goal.start_level};
  write_size(report);
  return {run::Outcome::finished, text_of(report)};
}

} // namespace

std::vector<std::string> size_judges() {
  return {levels::level_names({levels::Kind::reference}).front(), truth};
}

SizeEnd size_array(const SizeOrder& order, const levels::Prepared& p, const std::filesystem::path& folder) {
  const Sizing checked(p.inputs, *p.mesh); // refuses before anything is written
  if (order.against == truth) TruthStore::expect_known(p.inputs.scene);
  const TrialFolder kept(folder, hash_of(order, p));
  try {
    return search(order, p, folder, kept);
  } catch (const SearchStopped&) {
    return {run::Outcome::interrupted,
            fmt::format("{}: stopped; what was tried is safe in {}, and the same command goes on\n",
                        p.inputs.scene.name, folder.string())};
  }
}

} // namespace hopmesh::study
