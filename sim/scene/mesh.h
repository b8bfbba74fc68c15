// Scene -> mesh: nodes, springs, pins, and the surface that pictures need.
#pragma once

#include "sim/scene/scene.h"

namespace hopmesh::scene {

struct Spring {
  std::uint32_t node[2]; ///< node[0] < node[1]; no two springs join the same pair
  double weight;         ///< alpha
  double rest_length;    ///< m; 0 under a constant tension
};

/// A corner of a triangle: the node it sits on and its texture coordinates (0,0 is the picture's top left).
struct Corner {
  std::uint32_t node;
  float u, v;
};

struct Mesh {
  std::vector<Vector3> position; ///< [nodes] at the start, m: as built, or shuffled
  std::vector<Spring> springs;   ///< ascending by (node[0], node[1])
  std::vector<bool> pinned;      ///< [nodes]
  Vector3 velocity{0, 0, 0};     ///< m/s, of every free node at the start
  double mass = 1.0;             ///< kg per node
  bool planar = false;
  SpringLaw law = SpringLaw::linear;
  double floor = 0;                             ///< tension: m, above 0
  std::vector<std::array<Corner, 3>> triangles; ///< the surface, front side counter-clockwise
  std::vector<std::string> notes;               ///< what people should know of a mesh file: a line each

  std::size_t nodes() const { return position.size(); }
  Vector3 start_velocity(std::size_t node) const { return pinned[node] ? Vector3{0, 0, 0} : velocity; }
};

/// Builds the mesh of a scene. Throws InputError (input_error.h) for an unreadable or broken mesh file, a pin
/// that names no node, a mesh with no free node or no spring.
Mesh build_mesh(const Scene& scene);

} // namespace hopmesh::scene
