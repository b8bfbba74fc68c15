// A study's points, all checked before the first one runs.
#pragma once

#include "sim/study/point_runner.h"
#include "sim/study/study_file.h"

namespace hopmesh::study {

/// Methods outermost, then the axes in the file's order, the last one fastest.
Point point_of(const Study& study, std::size_t number);

/// Scene and array of a point. Mistakes are told by the study's own lines.
scene::Inputs inputs_of(const Study& study, const Point& point);

/// Builds every point's mesh; throws InputError for the first that cannot be. Returns a hash of all that
/// their results depend on: whoever goes on with a folder must come with the same one.
std::uint64_t check_points(const Study& study, const Methods& methods);

} // namespace hopmesh::study
