// What a campaign found: the case made as small as it gets, and a file that shows it again.
#pragma once

#include "sim/cosim/campaign.h"

#include <filesystem>

namespace hopmesh::cosim {

/// Runs `work` in a child process, so that neither a crash nor SystemC's one elaboration is ours. Its answer
/// (0 to 99), or 100 and the number of the signal that killed it; after `seconds` it is killed.
int in_child(const std::function<int()>& work, unsigned seconds);

/// Do these ways disagree on the job, or does one of them crash?
bool differs_in_child(const Ways& ways, const ArrayJob& job);

/// The two ways of a finding, or all where a crash does not say whose it is.
Ways involved(const Ways& ways, const Finding& finding);

/// A vector file with the job, the first way's answers (none if it crashes), and in comments what the
/// others say. Throws files::WriteError.
void write_finding(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                   const std::vector<std::string>& comments);

} // namespace hopmesh::cosim
