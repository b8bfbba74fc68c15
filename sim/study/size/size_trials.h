// Trials of `size`: a scene flown with settings of its array, in child processes, each tried once and for
// all.
#pragma once

#include "sim/run/progress.h"
#include "sim/run/snapshots.h"
#include "sim/study/size/trial_folder.h"

namespace hopmesh::study {

/// The user stopped the search; what was tried is safe.
class SearchStopped : public std::exception {};

/// What a motion came to that ended so far from its target, m.
TrialRow trial_row(const run::RunResult& result, double error);

class SizeTrials {
 public:
  /// `target`: where the motion should end. Everything must outlive the trials.
  SizeTrials(const Sizing& sizing, const TrialFolder& folder, const run::Positions& target,
             std::size_t workers)
      : sizing_(sizing), folder_(folder), target_(target), workers_(workers), progress_("trials", 0) {}

  /// A row for each setting, in their order. Throws SearchStopped.
  std::vector<TrialRow> rows(const std::vector<Setting>& settings);
  TrialRow row(const Setting& setting) { return rows({setting})[0]; }
  std::uint64_t flown() const { return flown_; } ///< by this process, not found in the folder

 private:
  int fly(const Setting& setting) const;

  const Sizing& sizing_;
  const TrialFolder& folder_;
  const run::Positions& target_;
  const std::size_t workers_;
  run::CountProgress progress_;
  std::uint64_t flown_ = 0;
};

} // namespace hopmesh::study
