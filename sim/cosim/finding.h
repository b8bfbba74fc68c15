// What a campaign found: the case made as small as it gets, and a file that shows it again.
#pragma once

#include "sim/cosim/campaign.h"

#include <filesystem>

namespace hopmesh::cosim {

/// Do these contestants disagree on the job, or does one of them crash?
bool differs_in_child(const std::vector<Contestant>& contestants, const ArrayJob& job);

/// The two contestants of a finding, or all where a crash does not say whose it is.
std::vector<Contestant> involved(const std::vector<Contestant>& contestants, const Finding& finding);

/// A vector file with the job, the first contestant's answers (none if it crashes), and in comments what the
/// others say. Throws record::WriteError.
void write_finding(const std::filesystem::path& path, const VectorCase& a_case,
                   const std::vector<Contestant>& contestants, const std::vector<std::string>& comments);

} // namespace hopmesh::cosim
