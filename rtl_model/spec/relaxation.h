// What a run of an array comes to.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hopmesh::spec {

/// How the registers STOP and SUM_THRESHOLD say that a run ends (docs/hardware/datapath.md, "Rest").
struct StopRule {
  bool by_sum = false;     ///< by the largest |s|, not by the largest |Delta V|
  int share = 0;           ///< at 2^-share of the first sweep's; 0: at `floor` alone
  std::uint64_t floor = 0; ///< or at so much, a raw code of the accumulator

  bool operator==(const StopRule& o) const {
    return by_sum == o.by_sum && share == o.share && floor == o.floor;
  }
};

/// A run, from START taken to DONE, as the registers tell it.
struct Relaxation {
  std::uint32_t sweeps = 0;
  bool converged = false;
  std::uint32_t largest_change = 0; ///< |Delta V| of the last sweep, raw code of the state
  std::uint64_t cycles = 0;
  /// |s| of the last sweep, of neurons that no bound holds: raw code of the accumulator; 0 without `by_sum`.
  std::uint64_t largest_sum = 0;

  bool operator==(const Relaxation& o) const {
    return sweeps == o.sweeps && converged == o.converged && largest_change == o.largest_change &&
           cycles == o.cycles && largest_sum == o.largest_sum;
  }
};

/// The widest that s and u have swung over all neurons and runs, zero included: what a study of formats
/// wants to know. Hardware has no such registers.
struct Extremes {
  std::int64_t least_sum = 0, largest_sum = 0, least_drive = 0, largest_drive = 0;

  void note(std::int64_t sum, std::int64_t drive) { merge({sum, sum, drive, drive}); }
  void merge(const Extremes& other) {
    least_sum = std::min(least_sum, other.least_sum);
    largest_sum = std::max(largest_sum, other.largest_sum);
    least_drive = std::min(least_drive, other.least_drive);
    largest_drive = std::max(largest_drive, other.largest_drive);
  }
  bool operator==(const Extremes& o) const {
    return least_sum == o.least_sum && largest_sum == o.largest_sum && least_drive == o.least_drive &&
           largest_drive == o.largest_drive;
  }
};

} // namespace hopmesh::spec
