// What a campaign found: the case made as small as it gets, and a file that shows it again.
#pragma once

#include "sim/cosim/campaign.h"

#include <filesystem>

namespace hopmesh::cosim {

/// Do these ways disagree on the job, or does one of them crash?
bool differs_in_child(const Ways& ways, const ArrayJob& job);

/// The two ways of a finding, or all where a crash does not say whose it is.
Ways involved(const Ways& ways, const Finding& finding);

/// A vector file with the job, the first way's answers (none if it crashes), and in comments what the
/// others say. Throws files::WriteError.
void write_finding(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                   const std::vector<std::string>& comments);

struct KeptFinding {
  ArrayJob job; ///< the smallest that still differs
  bool repeats; ///< else the case by itself does not differ, and is kept as it is
};
/// The case of a finding made small, until the user stops that, and written with `comments` below what
/// differs. Throws files::WriteError.
KeptFinding keep_finding(const std::filesystem::path& path, const Ways& ways, const CampaignPlan& plan,
                         const Finding& finding, const std::vector<std::string>& comments);

} // namespace hopmesh::cosim
