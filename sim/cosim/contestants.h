// The fixed levels as judges of one job: by name, and in all the ways in which the engine can compute.
#pragma once

#include "sim/cosim/contest.h"

namespace hopmesh::cosim {

/// Levels without the reference, which has no codes: engine, systemc, systemc-clock.
const std::vector<std::string>& fixed_level_names();
/// Throws scene::InputError for any other name; `flag` is where it stood.
void check_fixed_level(const std::string& name, const std::string& flag);

/// The level as run and compare have it.
cosim::Contestant contestant_of(const std::string& level);
/// For a campaign: the engine with every kernel, on two threads, and with sweeps that follow each other; what
/// is slow takes part in a share of the cases.
std::vector<cosim::Contestant> contestants_of(const std::vector<std::string>& levels);

} // namespace hopmesh::cosim
