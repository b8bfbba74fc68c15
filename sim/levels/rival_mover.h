// A rival as a motion, so that run and study take it as they take a level of the array.
#pragma once

#include "sim/levels/mover.h"
#include "sim/rivals/integrator.h"

namespace hopmesh::levels {

/// What acts on a scene's mesh. Throws input::InputError for a scene that rivals and truth cannot move.
rivals::Surroundings surroundings_of(const scene::Scene& scene);

class RivalMover : public Mover {
 public:
  /// `name`: one of rivals::names(). The mesh must outlive it.
  RivalMover(const std::string& name, const scene::Scene& scene, const BuiltMesh& mesh);

  StepRow advance() override;
  const std::vector<double>& positions() const override { return position_; }
  StepState state() const override;
  void restore(const StepState& state, const std::vector<SignalRange>& seen) override;

 private:
  void show_state();

  const BuiltMesh& mesh_;
  const rivals::Physics physics_;
  const double time_step_;
  std::unique_ptr<rivals::Method> method_;
  std::uint64_t step_ = 0;
  std::vector<double> position_, velocity_;
};

} // namespace hopmesh::levels
