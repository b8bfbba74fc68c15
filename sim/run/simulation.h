// The time-step loop: advance, record, watch, until done, diverged or interrupted.
#pragma once

#include "sim/levels/mover.h"
#include "sim/run/outcome.h"
#include "sim/run/step_log.h"

#include <atomic>

namespace hopmesh::run {

/// A spring this many times its rest length ends a run: the motion has left the model.
inline constexpr double most_stretch = 10.0;

struct RunResult {
  Outcome outcome = Outcome::finished;
  std::string sentence; ///< how it ended, for people
  StepLog rows;
  double wall_seconds = 0;
  double processor_seconds = 0; ///< of all threads, without an earlier process
};

/// Receives every good step as it happens.
class StepSink {
 public:
  virtual ~StepSink() = default;
  virtual void step(const levels::StepRow& row, const levels::Mover& motion) = 0;
};

/// Advances `motion` until `steps` are done, those of `earlier` among them (their rows, their time). Sinks
/// see each new step in turn; `stop` is looked at between steps.
RunResult simulate(levels::Mover& motion, std::uint64_t steps, const std::vector<StepSink*>& sinks,
                   const std::atomic<bool>& stop, RunResult earlier = {});

} // namespace hopmesh::run
