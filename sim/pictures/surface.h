// The mesh as a viewer wants it: vertices split where the picture jumps, upright, with smooth normals.
#pragma once

#include "sim/pictures/run_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopmesh::pictures {

using Floats = std::vector<float>;

/// A place where texture coordinates jump is two vertices of one node.
struct Surface {
  std::vector<std::uint32_t> node; ///< of each vertex
  Floats uv;
  std::vector<std::uint32_t> indices; ///< triangles, or pairs when there are none
  bool triangles = true;
};

Surface surface_of(const RunView& view);

/// glTF is y-up: a quarter turn brings the scene's own up there and keeps left and right.
template <typename Number> std::array<Number, 3> turned(const std::string& up, Number x, Number y, Number z) {
  if (up == "x") return {-y, x, z};
  if (up == "z") return {x, z, -y};
  return {x, y, z};
}

/// Places of the surface's vertices in a frame, turned so that the scene's up is +y.
Floats positions_of(const RunView& view, const Surface& surface, std::size_t frame);

/// Smooth normals: the triangles' cross products summed per node, so that seams in the picture stay unseen.
Floats normals_of(const Surface& surface, const Floats& positions, std::size_t nodes);

} // namespace hopmesh::pictures
