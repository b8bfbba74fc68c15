// From nodes and triangles to vertices, indices and normals.
#include "sim/pictures/surface.h"

#include <cmath>

namespace hopmesh::pictures {
namespace {

Surface lines_of(const RunView& view) {
  Surface surface;
  surface.triangles = false;
  for (std::size_t n = 0; n < view.nodes; ++n) surface.node.push_back(static_cast<std::uint32_t>(n));
  for (const auto& spring : view.springs)
    surface.indices.insert(surface.indices.end(), {spring.node[0], spring.node[1]});
  return surface;
}

} // namespace

Surface surface_of(const RunView& view) {
  if (view.triangles.empty()) return lines_of(view);
  constexpr std::uint32_t none = UINT32_MAX;
  Surface surface;
  std::vector<std::uint32_t> first(view.nodes, none); // vertex of each node, then the node's others
  std::vector<std::uint32_t> next;
  surface.indices.reserve(3 * view.triangles.size());
  for (const auto& triangle : view.triangles)
    for (const ViewCorner& c : triangle) {
      std::uint32_t* place = &first[c.node];
      while (*place != none && !(surface.uv[2 * *place] == c.u && surface.uv[2 * *place + 1] == c.v))
        place = &next[*place];
      if (*place == none) {
        *place = static_cast<std::uint32_t>(surface.node.size());
        surface.indices.push_back(*place);
        surface.node.push_back(c.node);
        surface.uv.insert(surface.uv.end(), {c.u, c.v});
        next.push_back(none); // after all use of `place`: this may move what it points to
      } else {
        surface.indices.push_back(*place);
      }
    }
  return surface;
}

Floats positions_of(const RunView& view, const Surface& surface, std::size_t frame) {
  Floats out(surface.node.size() * 3);
  float* at = out.data();
  for (const auto node : surface.node) {
    const float* p = view.frames[frame].data() + std::size_t{node} * 3;
    for (const float coordinate : turned(view.up, p[0], p[1], p[2])) *at++ = coordinate;
  }
  return out;
}

Floats normals_of(const Surface& surface, const Floats& positions, std::size_t nodes) {
  std::vector<std::array<double, 3>> sums(nodes, {0, 0, 0});
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const float* a = &positions[std::size_t{surface.indices[i]} * 3];
    const float* b = &positions[std::size_t{surface.indices[i + 1]} * 3];
    const float* c = &positions[std::size_t{surface.indices[i + 2]} * 3];
    const double u[3] = {double{b[0]} - a[0], double{b[1]} - a[1], double{b[2]} - a[2]};
    const double v[3] = {double{c[0]} - a[0], double{c[1]} - a[1], double{c[2]} - a[2]};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      auto& sum = sums[surface.node[surface.indices[i + corner]]];
      for (int k = 0; k < 3; ++k)
        sum[static_cast<std::size_t>(k)] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
  }
  Floats out;
  out.reserve(surface.node.size() * 3);
  for (const auto node : surface.node) {
    const auto& n = sums[node];
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const bool flat = size > 0 && std::isfinite(size);
    for (std::size_t k = 0; k < 3; ++k)
      out.push_back(flat ? static_cast<float>(n[k] / size) : k == 1 ? 1.0f : 0.0f);
  }
  return out;
}

} // namespace hopmesh::pictures
