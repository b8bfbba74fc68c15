#include "sim/study/point_runner.h"

#include "rtl_model/spec/schedule.h"
#include "sim/levels/multiplies.h"
#include "sim/machine/cost/whole_cost.h"
#include "sim/machine/silicon.h"
#include "sim/machine/timeline.h"
#include "sim/run/run_totals.h"
#include "sim/scene/frequency.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

namespace {

std::vector<Maybe> distances(const std::vector<run::Positions>& ours,
                             const std::vector<run::Positions>& theirs) {
  std::vector<Maybe> all(ours.size());
  for (std::size_t k = 0; k < ours.size() && k < theirs.size(); ++k)
    if (!ours[k].empty() && ours[k].size() == theirs[k].size())
      all[k] = run::rms_distance(ours[k], theirs[k]);
  return all;
}

/// Empty where the model has nothing to go by.
Maybe known(double figure) {
  return std::isnan(figure) ? Maybe{} : Maybe{figure};
}

void add_hardware(const scene::Inputs& inputs, const spec::Topology& t, std::uint64_t runs, PointRow& row) {
  const spec::ArraySpec& array = inputs.array;
  const machine::Work work{row.cycles, row.bus_cycles, row.sweeps,
                           inputs.scene.host.known_seconds(row.instructions.value_or(0))};
  const machine::Timeline timeline = machine::timeline_of(array, t, work);
  row.hardware_seconds = timeline.time().seconds(array.clock_mhz);
  row.utilisation = timeline.utilisation();
  row.utilisation_with_bus = timeline.utilisation_with_bus();
  row.multiplies = row.sweeps * levels::multiplies_a_sweep(array, t);
  row.memory_bits = machine::memory_bits(array, t).total();
  row.multiplier_bits = machine::multiplier_bits(array, t).total();
  row.divider_bits = machine::divider_bits(array, t);
  row.area_kge = known(machine::area_kge(array, t));
  row.energy_joule = known(machine::energy_joule(array, t, work, runs));
}

void sum_up(const run::RunResult& result, const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
            PointRow& row) {
  using levels::ReferenceError;
  using levels::StepRow;
  using levels::Summary;
  row.steps = result.rows.size();
  row.sweeps = run::count_of(result.rows, &StepRow::sweeps, Summary::sum);
  row.cycles = run::count_of(result.rows, &StepRow::cycles, Summary::sum);
  row.bus_cycles = run::count_of(result.rows, &StepRow::bus_cycles, Summary::sum);
  row.largest_strain = run::total_of(result.rows, &StepRow::max_strain, Summary::largest);
  if (run::is_judged(result.rows)) {
    const auto over_steps = [&](double ReferenceError::*figure, Summary how) {
      return run::total_of(result.rows, figure, how);
    };
    row.output_error = over_steps(&ReferenceError::rms_output, Summary::rms);
    row.output_error_median = over_steps(&ReferenceError::rms_output, Summary::median);
    row.rounding_error = over_steps(&ReferenceError::rounding, Summary::rms);
    row.rounding_error_median = over_steps(&ReferenceError::rounding, Summary::median);
    row.stopping_error = over_steps(&ReferenceError::stopping, Summary::rms);
    row.stopping_error_median = over_steps(&ReferenceError::stopping, Summary::median);
  }
  row.array_seconds = static_cast<double>(row.cycles) / (inputs.array.clock_mhz * 1e6);
  if (inputs.scene.host.counts() && row.cycles > 0)
    row.instructions = run::total_of(result.rows, &StepRow::instructions, Summary::sum);
  const std::uint64_t runs = row.steps * static_cast<std::uint64_t>(inputs.scene.relax.expansions);
  if (row.cycles > 0) add_hardware(inputs, mesh.topology(), runs, row);
}

StabilityFacts facts_of(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                        const run::RunResult& result) {
  StabilityFacts facts;
  facts.diverged = result.outcome == run::Outcome::diverged;
  facts.outputs = mesh.topology().neurons();
  facts.friction = std::pow(scene::kept_speed(inputs.scene.motion, inputs.scene.force),
                            static_cast<double>(result.rows.stride()));
  return facts;
}

} // namespace

PointRow run_point(const Point& point, const scene::Inputs& inputs, const std::vector<double>& times,
                   const Methods& methods, const std::atomic<bool>& stop) {
  const levels::BuiltMesh mesh(inputs.scene);
  const auto motion = methods.make(point.method, inputs);
  run::Snapshots ours(times, inputs.scene.motion.time_step);
  const auto steps = static_cast<std::uint64_t>(inputs.scene.motion.steps);
  const run::RunResult result = run::simulate(*motion, steps, {&ours}, stop);
  PointRow row;
  row.outcome = result.outcome;
  row.sentence = result.sentence;
  row.host_seconds = std::max(0.0, result.processor_seconds - motion->judging_seconds());
  sum_up(result, inputs, mesh, row);
  row.omega = scene::largest_frequency(mesh.mesh());
  row.stability = classify(result.rows.kept(), facts_of(inputs, mesh, result));
  if (row.steps > 0) {
    const FreeMotion reference = methods.reference(inputs, mesh, times, row.steps, stop);
    if (!reference.last.empty()) row.position_error = run::rms_distance(motion->positions(), reference.last);
    row.reference_at = distances(ours.at, reference.at);
  }
  if (!times.empty()) {
    const Truth truth = methods.truth(inputs, mesh, times);
    row.truth_at = distances(ours.at, truth.positions);
    row.floor_at.assign(truth.floor.begin(), truth.floor.end());
    row.sensitivity_at = methods.sensitivity(inputs, mesh, times);
  }
  return row;
}

} // namespace hopmesh::study
