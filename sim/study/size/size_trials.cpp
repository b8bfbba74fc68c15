#include "sim/study/size/size_trials.h"

#include "sim/levels/interrupt.h"
#include "sim/levels/level.h"
#include "sim/run/children.h"

namespace hopmesh::study {

TrialRow trial_row(const run::RunResult& result, double error) {
  using levels::StepRow;
  using levels::Summary;
  TrialRow row;
  row.outcome = result.outcome;
  if (result.outcome == run::Outcome::finished) row.error = error;
  row.sweeps = run::count_of(result.rows, &StepRow::sweeps, Summary::sum);
  row.most_sweeps = run::count_of(result.rows, &StepRow::sweeps, Summary::largest);
  row.cycles = run::count_of(result.rows, &StepRow::cycles, Summary::sum);
  row.bus_cycles = run::count_of(result.rows, &StepRow::bus_cycles, Summary::sum);
  row.most_cycles = result.rows.slowest();
  return row;
}

// In a child.
int SizeTrials::fly(const Setting& setting) const {
  levels::Prepared p{sizing_.inputs_of(setting), nullptr};
  p.mesh = std::make_unique<levels::BuiltMesh>(p.inputs.scene);
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p);
  const auto steps = static_cast<std::uint64_t>(p.inputs.scene.motion.steps);
  const run::RunResult result = run::simulate(*level.mover, steps, {}, levels::stop_requested);
  if (levels::stop_requested) return run::child_stopped;
  folder_.save(setting, trial_row(result, run::rms_distance(level.mover->positions(), target_)));
  return run::child_done;
}

std::vector<TrialRow> SizeTrials::rows(const std::vector<Setting>& settings) {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < settings.size(); ++k)
    if (!folder_.find(settings[k])) missing.push_back(k);
  const bool whole = run::run_in_children(
      missing, workers_, [&](std::size_t k) { return fly(settings[k]); },
      [&](std::size_t k, const run::ChildEnd& end) {
        const bool asked =
            levels::stop_requested || end.exit_code == run::child_stopped || end.from_outside();
        if (!asked && !folder_.find(settings[k])) folder_.save(settings[k], {});
        progress_.count(++flown_);
      },
      levels::stop_requested);
  if (!whole || levels::stop_requested) throw SearchStopped();
  for (const Setting& setting : settings)
    if (!folder_.find(setting))
      throw run::Refused(
          "a trial was ended from outside; what was tried is safe, and the same command goes on");
  std::vector<TrialRow> rows;
  for (const Setting& setting : settings) rows.push_back(folder_.find(setting).value());
  return rows;
}

} // namespace hopmesh::study
