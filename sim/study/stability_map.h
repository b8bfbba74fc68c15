// The classes of a study's points as a map over two axes of numbers.
#pragma once

#include "sim/study/study_file.h"

#include <filesystem>

namespace hopmesh::study {

/// Throws input::InputError for a study without two axes of numbers.
void check_map(const Study& study);
/// stability.csv, stability.svg and report.html beside the results in the folder. False where there are none.
bool draw_map(const std::filesystem::path& folder, const Study& study);

} // namespace hopmesh::study
