// Wavefront OBJ: the part of it that is a surface or a graph (v, vt, f, l).
#pragma once

#include "sim/scene/mesh.h"

#include <string>

namespace hopmesh::scene {

/// What becomes of vertices that do not hang together as the file stands.
struct ObjChoices {
  Loose loose = Loose::drop;
  bool weld = false; ///< vertices at one place become one node
};

struct ObjSurface {
  std::vector<Vector3> position; ///< as written, of those vertices that became nodes
  std::vector<std::array<std::uint32_t, 2>>
      edges; ///< of polygons and lines, ascending, each once, smaller node first
  std::vector<std::array<Corner, 3>> triangles; ///< polygons cut into fans
  std::vector<std::uint32_t> loose;             ///< nodes that no face or line uses, where they are kept
  std::size_t twins = 0;                        ///< nodes at a place where another one stands before them
  std::vector<std::string> notes;               ///< a line for everything that was left out
};

/// Throws InputError with file and line for whatever is broken: a number, an index, an edge without length, a
/// file without faces and lines.
ObjSurface read_obj(const std::string& path, const ObjChoices& choices = {});

} // namespace hopmesh::scene
