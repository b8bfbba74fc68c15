// The steps of build_mesh, each with a source of its own.
#pragma once

#include "sim/scene/mesh.h"

namespace hopmesh::scene {

/// Nodes, springs (rest lengths still 0) and triangles of a grid.
void build_grid(const Scene& scene, Mesh& mesh);

/// What of a file shows only when pins and springs are there.
struct FileFacts {
  std::vector<std::uint32_t> loose; ///< nodes without a spring, to be pinned
  std::size_t twins = 0;            ///< nodes at a place where another one stands
};

/// Nodes, springs and triangles of the scene's mesh file.
FileFacts build_from_file(const Scene& scene, Mesh& mesh);

/// Marks the pinned nodes. Throws InputError for a pin that names no node of this mesh.
void pin_nodes(const Scene& scene, Mesh& mesh);

/// Moves free nodes to where they start; springs keep the rest lengths of the places they were built at.
void shuffle_nodes(const Start& start, Mesh& mesh);

/// Node -> a node that stands for everything joined to it by springs.
std::vector<std::uint32_t> parts_of(const Mesh& mesh);

/// Adds what a file's mesh may do that nobody asked for: parts that fall, seams that open, a spring far
/// shorter than all others.
void note_surprises(const Scene& scene, const FileFacts& facts, Mesh& mesh);

} // namespace hopmesh::scene
