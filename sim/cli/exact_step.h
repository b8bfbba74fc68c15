// The step that the incremental formulation approximates, solved to the end: backward Euler's or BDF2's by
// Newton's method, with the scene's friction as the scene has it, a factor on v after each step.
#pragma once

#include "sim/cli/rival_motion.h"

namespace hopmesh::cli {

class ExactStep : public study::Motion {
 public:
  /// Of an incremental scene; the mesh must outlive it.
  ExactStep(const scene::Scene& scene, const study::BuiltMesh& mesh);

  study::StepRow advance() override;
  const std::vector<double>& positions() const override { return rival_.positions(); }
  study::StepState state() const override { return rival_.state(); }
  void restore(const study::StepState& state, const std::vector<study::SignalRange>& seen) override {
    rival_.restore(state, seen);
  }

 private:
  RivalMotion rival_;
  const double friction_;
};

} // namespace hopmesh::cli
