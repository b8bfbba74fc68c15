// Makes the steps of a run safe: after every so many, and whenever asked.
#pragma once

#include "sim/run/run_files.h"

#include <chrono>
#include <functional>

namespace hopmesh::run {

class Checkpointer : public StepSink {
 public:
  /// Called once so many steps are on the disk: they outlive whatever happens next.
  using Safe = std::function<void(std::uint64_t steps)>;

  /// `every` 0: only when asked. `seconds`: that the run took before. Must come behind `files` among the
  /// sinks.
  Checkpointer(RunFiles& files, std::uint64_t every, double seconds, Safe safe);

  void step(const levels::StepRow& row, const levels::Mover& motion) override;
  /// The steps that the motion has done are safe once this returns. Throws record::WriteError; then those of
  /// the checkpoint before still are.
  void save(const levels::Mover& motion);

 private:
  RunFiles& files_;
  const std::uint64_t every_;
  const double seconds_;
  const std::chrono::steady_clock::time_point began_;
  const Safe safe_;
};

} // namespace hopmesh::run
