// The order in which blocks fire: group by group, on one thread or several; or several sweeps following each
// other through the mesh, so that a network larger than a cache is read once for all of them.
#pragma once

#include "sim/engine/run_rule.h"
#include "sim/engine/sweep_core.h"
#include "sim/engine/team.h"

namespace hopmesh::engine {

/// What sweeps come to: the last one as the detector saw it, whether the rule ended the run with it, and the
/// extremes of all.
struct SweepResult {
  Detected detected;
  bool over = false;
  spec::Extremes extremes;
};

class Sweeper {
 public:
  /// `followed`: sweeps that follow each other. Taken as 1 in sequential arrays and in layouts of one chunk.
  Sweeper(SweepCore& core, const Layout& layout, RunRule& rule, std::size_t threads, std::size_t followed);

  std::size_t threads() const { return team_.size(); }

  /// Prepares all rows for a run by the rule as it has begun.
  void prepare();
  /// Sweeps until the rule ends the run, or `limit` sweeps are done, or `stop`. Returns how many were done;
  /// what they came to stands in `result`.
  std::uint32_t relax(std::uint32_t limit, const std::atomic<bool>& stop, SweepResult& result);

 private:
  std::uint32_t relax_plainly(std::uint32_t limit, const std::atomic<bool>& stop, SweepResult& result);
  std::uint32_t relax_following(std::uint32_t limit, const std::atomic<bool>& stop, SweepResult& result);
  void end_sweeps(std::uint32_t count, const Detected& last);
  void fire_sweep(std::size_t member, const SweepOrder& order, SweepRecord& record);
  void fire_group(std::size_t group, std::size_t member, const SweepOrder& order, SweepRecord& record);
  std::size_t judged(std::vector<SweepResult>& each) const;
  std::vector<SweepResult> follow(std::size_t sweeps);
  void follow(std::size_t sweeps, std::size_t member, std::vector<SweepRecord>& records);

  SweepCore& core_;
  const Layout& layout_;
  RunRule& rule_;
  std::size_t followed_;
  std::uint32_t expected_ = 0; ///< sweeps of the last run; 0: none
  Team team_;
  std::vector<std::size_t> lag_; ///< in chunks, of each stage of `followed_` sweeps (lags)
};

} // namespace hopmesh::engine
