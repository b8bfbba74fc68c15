// The differential campaign: random cases, all levels, in child processes.
#pragma once

#include "sim/cosim/contest.h"
#include "sim/cosim/vectors.h"

#include <atomic>
#include <optional>

namespace hopmesh::cosim {

/// Case `number` of a seed: the same on every machine. A quarter of them are presets, one in 64 is large, and
/// one in four is compared after every sweep.
struct CampaignCase {
  ArrayJob job;
  bool every_sweep = false;
};
CampaignCase campaign_case(std::uint64_t seed, std::uint64_t number);
/// As that, on one of these arrays, which are taken as they are.
CampaignCase campaign_case(std::uint64_t seed, std::uint64_t number,
                           const std::vector<spec::ArraySpec>& arrays);

struct CampaignPlan {
  std::uint64_t seed = 1, first = 0;
  std::uint64_t cases = UINT64_MAX;         ///< at most so many
  double seconds = 1e300;                   ///< no batch is begun after them
  std::size_t children = 1;                 ///< at once
  std::vector<spec::ArraySpec> arrays = {}; ///< of the cases; none: random ones
};

struct Finding {
  std::uint64_t number = 0;
  std::size_t way = 0; ///< that differs from the first; 0: one of them crashed
  std::string text;
};

struct CampaignResult {
  std::uint64_t cases = 0; ///< done
  std::uint64_t next = 0;  ///< where to go on
  double seconds = 0;
  bool interrupted = false;
  std::optional<Finding> finding; ///< the first; it ends the campaign
};

/// Forks before anything of SystemC is made: the calling process must not have made any. `progress` is told
/// the number of cases done.
CampaignResult run_campaign(const Ways& ways, const CampaignPlan& plan,
                            const std::function<void(std::uint64_t)>& progress,
                            const std::atomic<bool>& stop);

} // namespace hopmesh::cosim
