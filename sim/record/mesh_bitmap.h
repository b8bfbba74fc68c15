// Shapes as a bitmap in which the nearest wins: for meshes of more shapes than a page of vectors can hold.
#pragma once

#include "sim/record/mesh_shapes.h"
#include "sim/record/png.h"

namespace hopmesh::record {

/// `zoom` pixels for each of the paper's.
Picture bitmap_of(const MeshShapes& shapes, std::uint32_t zoom, std::uint32_t faint);

} // namespace hopmesh::record
