#include "sim/cli/size_trials.h"

#include "sim/study/point_pool.h"

namespace hopmesh::cli {

namespace {

study::TrialRow row_of(const study::RunResult& result, double error) {
  study::TrialRow row;
  const bool finished = result.outcome == study::Outcome::finished;
  row.status = finished ? "finished" : "diverged";
  if (finished) row.error = error;
  for (const study::StepRow& step : result.rows) {
    row.sweeps += step.sweeps, row.cycles += step.cycles;
    row.most_sweeps = std::max(row.most_sweeps, step.sweeps);
    row.most_cycles = std::max(row.most_cycles, step.cycles);
  }
  return row;
}

} // namespace

// In a child.
int SizeTrials::fly(const study::Setting& setting) const {
  Prepared p{sizing_.inputs_of(setting), nullptr};
  p.mesh = std::make_unique<study::BuiltMesh>(p.inputs.scene);
  const Level level = make_level("engine", p, false, {{}, {}, true});
  const auto steps = static_cast<std::uint64_t>(p.inputs.scene.motion.steps);
  const study::RunResult result = study::simulate(*level.motion, steps, {}, stop_requested);
  if (stop_requested) return interrupted;
  folder_.keep(setting, row_of(result, study::rms_distance(level.motion->positions(), target_)));
  return done;
}

std::vector<study::TrialRow> SizeTrials::rows(const std::vector<study::Setting>& settings) {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < settings.size(); ++k)
    if (!folder_.find(settings[k])) missing.push_back(k);
  const bool whole = study::run_in_children(
      missing, workers_, [&](std::size_t k) { return fly(settings[k]); },
      [&](std::size_t k, const study::ChildEnd& end) {
        const bool asked = stop_requested || end.exit_code == interrupted;
        if (!asked && !folder_.find(settings[k])) folder_.keep(settings[k], {});
        progress_.count(++flown_);
      },
      stop_requested);
  if (!whole || stop_requested) throw SearchStopped();
  std::vector<study::TrialRow> rows;
  for (const study::Setting& setting : settings) rows.push_back(folder_.find(setting).value());
  return rows;
}

} // namespace hopmesh::cli
