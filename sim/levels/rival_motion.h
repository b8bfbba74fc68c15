// A rival as a motion, so that run and study take it as they take a level of the array.
#pragma once

#include "sim/rivals/method.h"
#include "sim/levels/motion.h"

namespace hopmesh::levels {

class RivalMotion : public levels::Motion {
 public:
  /// `name`: one of rivals::names(). The mesh must outlive it.
  RivalMotion(const std::string& name, const scene::Scene& scene, const levels::BuiltMesh& mesh);

  levels::StepRow advance() override;
  const std::vector<double>& positions() const override { return position_; }
  levels::StepState state() const override;
  void restore(const levels::StepState& state, const std::vector<levels::SignalRange>& seen) override;

 private:
  void keep();

  const levels::BuiltMesh& mesh_;
  const rivals::Physics physics_;
  const double time_step_;
  std::unique_ptr<rivals::Method> method_;
  std::uint64_t step_ = 0;
  std::vector<double> position_, velocity_;
};

} // namespace hopmesh::levels
