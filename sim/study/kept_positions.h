// Positions that several points of a study are measured against: one process works them out, the others wait,
// and they lie in the study's folder. A table and the positions beside it prove each other.
#pragma once

#include "sim/levels/exact_motion.h"

#include <filesystem>
#include <functional>

namespace hopmesh::study {

/// What lies under STEM.csv and STEM.npy, or what `work_out` finds: empty where that is empty, or where the
/// user stopped while another process worked. Throws files::DamagedFile where what lies there is not as it
/// was written.
levels::ExactMotion kept_positions(const std::filesystem::path& stem, const std::vector<double>& times,
                                   std::size_t nodes, const std::function<levels::ExactMotion()>& work_out);

} // namespace hopmesh::study
