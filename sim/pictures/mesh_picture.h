// picture.svg: the mesh at the end of a run, strong, over what it was at the start, faint.
#pragma once

#include "sim/pictures/run_view.h"

#include <filesystem>

namespace hopmesh::pictures {

/// Shapes that are drawn as vectors; more become a bitmap, so that the file stays small for any mesh.
inline constexpr std::size_t most_vectors = 4000;

/// The first and the last frame of a run. Throws WriteError.
void write_mesh_picture(const RunView& view, const std::filesystem::path& path);

} // namespace hopmesh::pictures
