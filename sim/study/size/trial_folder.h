// Trials of a search, each in a safe file of its own: a search that was killed finds again what it had tried.
#pragma once

#include "sim/run/outcome.h"
#include "sim/study/safe_folder.h"
#include "sim/study/size/sizing.h"

#include <cmath>

namespace hopmesh::study {

/// What a run with a setting came to.
struct TrialRow {
  run::Outcome outcome = run::Outcome::crashed;
  double error = HUGE_VAL;                   ///< rms of positions at the end, m
  std::uint64_t sweeps = 0, most_sweeps = 0; ///< in all, and of the longest step
  std::uint64_t cycles = 0, bus_cycles = 0;  ///< of the array and of the bus, in all
  std::uint64_t most_cycles = 0;             ///< of both, in the step that took longest
};

class TrialFolder {
 public:
  /// Takes up what is there; throws InputError where the folder belongs to other inputs (`hash`).
  TrialFolder(const std::filesystem::path& folder, std::uint64_t hash);

  std::optional<TrialRow> find(const Setting& setting) const;
  /// Safe from any kill once this returns.
  void save(const Setting& setting, const TrialRow& row) const;
  const std::filesystem::path& path() const { return safe_.path(); }

 private:
  const SafeFolder safe_;
};

} // namespace hopmesh::study
