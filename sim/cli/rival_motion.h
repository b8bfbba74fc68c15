// A rival as a motion, so that run and study take it as they take a level of the array.
#pragma once

#include "sim/rivals/method.h"
#include "sim/study/motion.h"

namespace hopmesh::cli {

class RivalMotion : public study::Motion {
 public:
  /// `name`: one of rivals::names(). The mesh must outlive it.
  RivalMotion(const std::string& name, const scene::Scene& scene, const study::BuiltMesh& mesh);

  study::StepRow advance() override;
  const std::vector<double>& positions() const override { return position_; }
  study::StepState state() const override;
  void restore(const study::StepState& state, const std::vector<study::SignalRange>& seen) override;

 private:
  void keep();

  const study::BuiltMesh& mesh_;
  const rivals::Physics physics_;
  const double time_step_;
  std::unique_ptr<rivals::Method> method_;
  std::uint64_t step_ = 0;
  std::vector<double> position_, velocity_;
};

} // namespace hopmesh::cli
