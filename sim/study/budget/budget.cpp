#include "sim/study/budget/budget.h"

#include "sim/files/output_file.h"
#include "sim/levels/exact_step.h"
#include "sim/levels/level.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/progress.h"
#include "sim/run/run_totals.h"
#include "sim/study/truth_store.h"
#include "sim/study/twin.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

constexpr std::uint64_t most_times = 10;

std::vector<double> times_of(const scene::MotionKeys& motion) {
  std::vector<double> times;
  const auto steps = static_cast<std::uint64_t>(motion.steps), count = std::min(steps, most_times);
  for (std::uint64_t k = 1; k <= count; ++k) {
    const std::uint64_t step = steps * k / count;
    times.push_back(static_cast<double>(step) * motion.time_step);
  }
  return times;
}

/// Keeps the sweeps of an array's steps.
class SweepWatch : public run::StepSink {
 public:
  explicit SweepWatch(const levels::ArrayMover& array) : array_(array) {}
  void step(const levels::StepRow&, const levels::Mover&) override { of.push_back(array_.last_sweeps()); }

  reference::SweepsOfSteps of;

 private:
  const levels::ArrayMover& array_;
};

/// Adds a link to the chain; false where its motion was interrupted.
bool fly(levels::Mover& mover, BudgetLink link, const scene::MotionKeys& motion, Budget& budget,
         run::StepSink* beside = nullptr) {
  const auto steps = static_cast<std::uint64_t>(motion.steps);
  run::Snapshots snapshots(budget.times, motion.time_step);
  std::vector<run::StepSink*> sinks{&snapshots};
  if (beside) sinks.push_back(beside);
  const run::RunResult result = run::simulate_shown(mover, steps, sinks);
  if (result.outcome == run::Outcome::diverged)
    budget.troubles.push_back(fmt::format("{}: {}", link.motion, result.sentence));
  const std::uint64_t unfinished =
      run::count_of(result.rows, &levels::StepRow::converged, levels::Summary::unmet);
  if (unfinished > 0) link.motion += fmt::format(" ({} of {} steps not at rest)", unfinished, steps);
  link.at = std::move(snapshots.at);
  budget.chain.push_back(std::move(link));
  return result.outcome != run::Outcome::interrupted;
}

std::vector<std::optional<double>> at_times(const Twin& twin, const Budget& budget, double time_step) {
  std::vector<std::optional<double>> at(budget.times.size());
  for (std::size_t k = 0; k < at.size(); ++k) at[k] = twin.apart_at(budget.times[k], time_step);
  return at;
}

/// A scene whose steps are made in whole numbers, by doubles; null for any other.
std::unique_ptr<levels::Prepared> by_doubles(const levels::Prepared& p) {
  if (p.inputs.scene.host.arithmetic != scene::Arithmetic::fixed) return nullptr;
  auto other = std::make_unique<levels::Prepared>(levels::Prepared{p.inputs, nullptr});
  other->inputs.scene.host.arithmetic = scene::Arithmetic::doubles;
  other->mesh = std::make_unique<levels::BuiltMesh>(other->inputs.scene);
  return other;
}

/// False where the user stopped it.
bool fly_all(const levels::Prepared& p, Budget& budget) {
  const scene::Scene& scene = p.inputs.scene;
  const std::unique_ptr<levels::Prepared> doubles = by_doubles(p);
  const levels::ReadyLevel array = levels::make_ready(levels::default_level(), doubles ? *doubles : p);
  SweepWatch sweeps(*array.array);
  levels::ReferenceMover same(scene, *p.mesh, p.inputs.array), rest(scene, *p.mesh, p.inputs.array);
  std::optional<levels::ExactStep> exact;
  if (levels::ExactStep::exists_for(scene)) exact.emplace(scene, *p.mesh);
  Twin twin(scene, *p.mesh, p.inputs.array);
  const auto link = [&](levels::Mover& mover, const std::string& motion, const std::string& mends,
                        run::StepSink* beside = nullptr) {
    return fly(mover, {motion, mends, {}}, scene.motion, budget, beside);
  };
  if (doubles) {
    const levels::ReadyLevel whole = levels::make_ready(levels::default_level(), p);
    if (!link(*whole.mover, "array " + p.inputs.array.name + ", its host in whole numbers", "host"))
      return false;
  }
  if (!link(*array.mover, "array " + p.inputs.array.name, "rounding", &sweeps)) return false;
  same.answer_after(sweeps.of);
  twin.answer_after(sweeps.of);
  rest.answer_at_rest();
  const bool flown = link(same, "reference, by as many sweeps in every step", "stopping", &twin);
  budget.sensitivity = at_times(twin, budget, scene.motion.time_step);
  return flown && link(rest, "reference, at rest in every step", "formulation") &&
         (!exact || link(*exact, scene.formulation_name() + ", each step solved exactly", "time step"));
}

void add_truth(const levels::Prepared& p, const std::filesystem::path& folder, Budget& budget) {
  const Truth truth = TruthStore(folder).at(p.inputs, *p.mesh, budget.times);
  if (truth.positions.empty())
    budget.troubles.emplace_back("truth: SUNDIALS gave up, so there is nothing to measure against");
  budget.floor = truth.floor;
  budget.chain.push_back({"truth: m dv/dt = springs - m c v + m force, by SUNDIALS", "", truth.positions});
}

void add_rows(Budget& budget) {
  for (std::size_t k = 0; k < budget.times.size(); ++k) {
    std::vector<const run::Positions*> positions;
    for (const BudgetLink& link : budget.chain)
      if (k < link.at.size() && !link.at[k].empty()) positions.push_back(&link.at[k]);
    if (positions.size() < budget.chain.size()) return;
    budget.rows.push_back(budget_of(positions));
    budget.rows.back().time = budget.times[k];
    budget.rows.back().floor = budget.floor[k];
    budget.rows.back().sensitivity = budget.sensitivity[k];
  }
}

} // namespace

void check_budget(const levels::Prepared& p, const std::filesystem::path& folder) {
  TruthStore::expect_known(p.inputs.scene);
  files::check_writable(folder, 0);
}

std::optional<Budget> work_out_budget(const levels::Prepared& p, const std::filesystem::path& folder) {
  Budget budget;
  budget.times = times_of(p.inputs.scene.motion);
  if (!fly_all(p, budget)) return std::nullopt;
  add_truth(p, folder, budget);
  add_rows(budget);
  return budget;
}

} // namespace hopmesh::study
