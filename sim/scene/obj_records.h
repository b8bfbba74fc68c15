// An OBJ file as it is written: vertices, faces and lines, nothing checked but that each can be read.
#pragma once

#include "sim/scene/mesh.h"

#include <string>

namespace hopmesh::scene {

/// A corner as written, both indices made absolute and counted from 0; texture -1: none.
struct ObjCorner {
  std::int64_t vertex, texture;
  int line;
};

/// Runs of corners one behind the other: faces, or lines.
struct ObjRuns {
  std::vector<ObjCorner> corner;
  std::vector<std::size_t> first; ///< where each run begins

  std::size_t count() const { return first.size(); }
  std::size_t begin(std::size_t run) const { return first[run]; }
  std::size_t end(std::size_t run) const { return run + 1 < first.size() ? first[run + 1] : corner.size(); }
};

struct ObjRecords {
  std::string path;
  std::vector<Vector3> position;
  std::vector<int> vertex_line;
  std::vector<std::array<float, 2>> texture; ///< v as pictures have it, down from the top
  ObjRuns faces, lines;
  std::vector<std::string> notes; ///< what was passed over
};

/// Throws InputError with file and line for a statement that cannot be read, and for a file of another kind.
ObjRecords read_obj_records(const std::string& path);

} // namespace hopmesh::scene
