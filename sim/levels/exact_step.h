// The step that the incremental formulation approximates, solved to the end: backward Euler's or BDF2's by
// Newton's method, with the scene's friction as the scene has it, a factor on v after each step.
#pragma once

#include "sim/levels/rival_mover.h"

namespace hopmesh::levels {

class ExactStep : public Mover {
 public:
  /// Where a rival bears the formulation's name.
  static bool exists_for(const scene::Scene& scene);
  /// The mesh must outlive it.
  ExactStep(const scene::Scene& scene, const BuiltMesh& mesh);

  StepRow advance() override;
  const std::vector<double>& positions() const override { return rival_.positions(); }
  StepState state() const override { return rival_.state(); }
  void restore(const StepState& state, const std::vector<SignalRange>& seen) override {
    rival_.restore(state, seen);
  }

 private:
  RivalMover rival_;
  const double friction_;
};

} // namespace hopmesh::levels
