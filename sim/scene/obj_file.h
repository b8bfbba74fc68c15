// Wavefront OBJ: the part of it that is a surface or a graph (v, vt, f, l).
#pragma once

#include "sim/scene/mesh.h"

namespace hopmesh::scene {

struct ObjSurface {
  std::vector<Vector3> position; ///< as written
  std::vector<std::array<std::uint32_t, 2>>
      edges; ///< of polygons and lines, ascending, each once, smaller node first
  std::vector<std::array<Corner, 3>> triangles; ///< polygons cut into fans
};

/// Throws InputError with file and line for whatever is broken: a number, an index, an edge without length, a
/// node that no face or line uses, a file without either.
ObjSurface read_obj(const std::string& path);

} // namespace hopmesh::scene
