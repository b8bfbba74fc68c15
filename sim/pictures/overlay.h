// A mesh drawn over the image that pulls it, as SVG.
#pragma once

#include "sim/files/grey_picture.h"

#include <array>
#include <filesystem>

namespace hopmesh::pictures {

/// In pixels: x from the left, y from the top, whole numbers at the middles of pixels.
struct OverlayLine {
  std::array<double, 2> from, to;
};

/// The lines of the start are faint, those of the end bright.
void write_overlay(const std::filesystem::path& path, const files::GreyPicture& picture,
                   const std::vector<OverlayLine>& start, const std::vector<OverlayLine>& end);

} // namespace hopmesh::pictures
