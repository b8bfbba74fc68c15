// How much a motion in double depends on the last place of its start. A second reference flies beside the
// first, its free nodes moved by one last place of the mesh's extent: what the two come to differ by is a
// floor. An error below it is luck, whoever makes it.
#pragma once

#include "sim/levels/reference_mover.h"
#include "sim/run/snapshots.h"
#include "sim/scene/scene_file.h"

#include <optional>

namespace hopmesh::study {

/// Watches a reference and flies its twin.
class Twin : public run::StepSink {
 public:
  Twin(const scene::Scene& scene, const levels::BuiltMesh& mesh, const spec::ArraySpec& array);
  void step(const levels::StepRow& row, const levels::Mover& reference) override;
  /// As levels::ReferenceMover::answer_after(): a twin has to answer as the reference beside it.
  void answer_after(reference::SweepsOfSteps sweeps) { twin_.answer_after(std::move(sweeps)); }

  /// Rms over nodes after each step, m; infinite from where the twin diverged.
  const std::vector<double>& apart() const { return apart_; }
  /// At a time; none where one of the two did not come so far.
  std::optional<double> apart_at(double time, double time_step) const;

 private:
  levels::ReferenceMover twin_;
  std::vector<double> apart_;
};

/// The distances of two such references at a few times, s; none where a motion did not come so far.
std::vector<std::optional<double>> sensitivity_of(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                                  const std::vector<double>& times,
                                                  const std::atomic<bool>& stop);

} // namespace hopmesh::study
