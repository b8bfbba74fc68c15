// picture.svg: the mesh at the end of a run, strong, over what it was at the start, faint.
#pragma once

#include "sim/pictures/run_view.h"

#include <filesystem>

namespace hopmesh::pictures {

/// A mesh of more shapes is drawn coarser, so that the file of any mesh stays small.
inline constexpr std::size_t most_shapes = 4000;

/// The first and the last frame of a run. Throws WriteError.
void write_mesh_picture(const RunView& view, const std::filesystem::path& path);

} // namespace hopmesh::pictures
