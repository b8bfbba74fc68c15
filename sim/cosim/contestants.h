// Levels with a bus as judges of one job: as they are, and in all the ways in which they can compute.
#pragma once

#include "sim/cosim/contest.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

/// The level as run and compare have it.
Contestant contestant_of(const levels::Level& level);
/// For a campaign: each level in all its ways; what is slow takes part in a share of the cases. The first
/// takes any job.
std::vector<Contestant> contestants_of(const std::vector<const levels::Level*>& levels);

} // namespace hopmesh::cosim
