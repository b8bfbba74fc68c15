// Shapes as a bitmap in which the nearest wins: for meshes of more shapes than a page of vectors can hold.
#pragma once

#include "sim/files/png.h"
#include "sim/pictures/mesh_shapes.h"

namespace hopmesh::pictures {

/// `zoom` pixels for each of the paper's.
files::Picture bitmap_of(const MeshShapes& shapes, std::uint32_t zoom, std::uint32_t faint);

} // namespace hopmesh::pictures
