// The steps of build_mesh, each with a source of its own.
#pragma once

#include "sim/scene/mesh.h"

namespace hopmesh::scene {

/// Nodes, springs (rest lengths still 0) and triangles of a grid.
void build_grid(const Scene& scene, Mesh& mesh);

/// Nodes, springs and triangles of the scene's mesh file.
void build_from_file(const Scene& scene, Mesh& mesh);

/// Marks the pinned nodes. Throws InputError for a pin that names no node of this mesh.
void pin_nodes(const Scene& scene, Mesh& mesh);

/// Moves free nodes to where they start; springs keep the rest lengths of the places they were built at.
void shuffle_nodes(const Start& start, Mesh& mesh);

} // namespace hopmesh::scene
