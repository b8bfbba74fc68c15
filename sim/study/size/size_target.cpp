#include "sim/study/size/size_target.h"

#include "sim/levels/reference_mover.h"
#include "sim/run/run_totals.h"
#include "sim/study/size/size_trials.h"
#include "sim/study/truth_store.h"

namespace hopmesh::study {

SizeTarget size_target(const levels::Prepared& p, bool truth, const std::filesystem::path& folder) {
  const scene::MotionKeys& motion = p.inputs.scene.motion;
  levels::ReferenceMover reference(p.inputs.scene, *p.mesh, p.inputs.array);
  const run::RunResult result = run::simulate_shown(reference, static_cast<std::uint64_t>(motion.steps));
  if (result.outcome == run::Outcome::interrupted) throw SearchStopped();
  SizeTarget target;
  target.positions = reference.positions();
  target.sweeps = run::count_of(result.rows, &levels::StepRow::sweeps, levels::Summary::sum);
  if (result.outcome == run::Outcome::diverged) target.trouble = "the reference: " + result.sentence;
  if (!truth || !target.trouble.empty()) return target;
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

} // namespace hopmesh::study
