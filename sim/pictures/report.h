// report.html: the whole run on one page that opens offline: the motion in 3-D, the charts, the numbers.
#pragma once

#include "sim/pictures/run_view.h"

#include <filesystem>

namespace hopmesh::pictures {

/// Where Debian's libjs-three lies. three.min.js is copied into the page; without it the page draws on a 2-D
/// canvas.
inline constexpr const char* debian_three_folder = "/usr/share/javascript/three";

void write_report(const RunView& view, const std::filesystem::path& path,
                  const std::filesystem::path& three_folder = debian_three_folder);

} // namespace hopmesh::pictures
