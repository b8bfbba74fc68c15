// Which nodes never move: by number, by the sides of a grid, by the ends of a file mesh's extent, or by
// place.
#include "sim/scene/limits.h"
#include "sim/scene/mesh_parts.h"
#include "sim/scene/scene_reader.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

void pin_number(const Scene& scene, std::int64_t number, Mesh& mesh) {
  if (number < 0 || number >= std::int64_t(mesh.nodes()))
    throw scene_error(scene, "mesh.pinned", fmt::format("node {}", number),
                      fmt::format("node numbers from 0 to {}", mesh.nodes() - 1));
  mesh.pinned[number] = true;
}

void pin_side_of_grid(const Grid& grid, const std::string& side, Mesh& mesh) {
  const int last_row = grid.rows - 1, last_column = grid.columns - 1;
  for (int r = 0; r <= last_row; ++r)
    for (int c = 0; c <= last_column; ++c) {
      const bool end_row = r == 0 || r == last_row, end_column = c == 0 || c == last_column;
      if ((side == "left" && c == 0) || (side == "right" && c == last_column) || (side == "top" && r == 0) ||
          (side == "bottom" && r == last_row) || (side == "corners" && end_row && end_column))
        mesh.pinned[std::size_t(r) * grid.columns + c] = true;
    }
}

/// Everything within the band at one end of the mesh's extent along an axis.
void pin_end(const Mesh& shape, int axis, bool high, double band, std::vector<bool>& pinned) {
  const auto less = [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; };
  const auto [low, top] = std::minmax_element(shape.position.begin(), shape.position.end(), less);
  const double reach = band * ((*top)[axis] - (*low)[axis]), from = (*low)[axis] + reach,
               to = (*top)[axis] - reach;
  for (std::size_t i = 0; i < shape.nodes(); ++i) {
    const double x = shape.position[i][axis];
    if (high ? x >= to : x <= from) pinned[i] = true;
  }
}

void pin_end_of_file_mesh(const Scene& scene, const std::string& end, Mesh& mesh) {
  if (end == "corners")
    throw scene_error(scene, "mesh.pinned", "\"corners\"",
                      "left, right, top, bottom or node numbers in a mesh file");
  const int up = static_cast<int>(scene.mesh.up), across = up == 0 ? 1 : 0;
  const bool vertical = end == "top" || end == "bottom", high = end == "top" || end == "right";
  pin_end(mesh, vertical ? up : across, high, scene.mesh.pin_band, mesh.pinned);
}

void pin_name(const Scene& scene, const std::string& name, Mesh& mesh) {
  if (std::find(pin_names.begin(), pin_names.end(), name) == pin_names.end())
    throw scene_error(scene, "mesh.pinned", input::in_quotes(name),
                      "left, right, top, bottom, corners or node numbers",
                      input::nearest_name(name, pin_names));
  if (scene.mesh.grid)
    pin_side_of_grid(*scene.mesh.grid, name, mesh);
  else
    pin_end_of_file_mesh(scene, name, mesh);
}

void pin_inside(const Scene& scene, const PinBall& ball, Mesh& mesh) {
  bool found = false;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const Vector3& x = mesh.position[i];
    const double d[3] = {x[0] - ball.centre[0], x[1] - ball.centre[1], x[2] - ball.centre[2]};
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > ball.radius * ball.radius) continue;
    mesh.pinned[i] = found = true;
  }
  if (!found)
    throw scene_error(scene, "mesh.pin_ball", "no node inside",
                      fmt::format("at least one node within {} m of its centre", ball.radius));
}

} // namespace

void pin_nodes(const Scene& scene, Mesh& mesh) {
  mesh.pinned.assign(mesh.nodes(), false);
  for (const Pin& pin : scene.mesh.pinned)
    if (const auto* number = std::get_if<std::int64_t>(&pin))
      pin_number(scene, *number, mesh);
    else
      pin_name(scene, std::get<std::string>(pin), mesh);
  if (scene.mesh.pin_ball) pin_inside(scene, *scene.mesh.pin_ball, mesh);
}

} // namespace hopmesh::scene
