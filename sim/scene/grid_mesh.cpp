// A sheet hanging in the x-z plane: node r * columns + c at (c * pitch, 0, -r * pitch).
#include "sim/scene/limits.h"
#include "sim/scene/mesh_parts.h"
#include "sim/scene/scene_reader.h"

#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

/// To a neighbour that comes later in node order, which is why only these six exist.
struct Step {
  int down, right;
  double weight;
};

/// In ascending order of the neighbour's number, so that springs come out sorted.
std::vector<Step> steps_of(const MeshSpec& m) {
  const std::vector<Step> all{{0, 1, m.structural}, {0, 2, m.bend},  {1, -1, m.shear},
                              {1, 0, m.structural}, {1, 1, m.shear}, {2, 0, m.bend}};
  std::vector<Step> kept;
  for (const Step& step : all)
    if (step.weight != 0) kept.push_back(step);
  return kept;
}

bool contains(const Grid& grid, int row, int column) {
  return row < grid.rows && column >= 0 && column < grid.columns;
}

void place_nodes(const Grid& grid, Mesh& mesh) {
  mesh.position.reserve(std::size_t(grid.rows) * grid.columns);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) mesh.position.push_back({c * grid.pitch, 0, 0 - r * grid.pitch});
}

void join_nodes(const Grid& grid, const std::vector<Step>& steps, Mesh& mesh) {
  mesh.springs.reserve(mesh.nodes() * steps.size());
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      for (const Step& s : steps)
        if (contains(grid, r + s.down, c + s.right)) {
          const std::uint32_t from = r * grid.columns + c, to = from + s.down * grid.columns + s.right;
          mesh.springs.push_back({{from, to}, s.weight, 0});
        }
}

Corner corner(const Grid& grid, int r, int c) {
  return {std::uint32_t(r * grid.columns + c), float(c) / float(grid.columns - 1),
          float(r) / float(grid.rows - 1)};
}

/// The front is the side seen from -y, with x to the right and z up.
void cover(const Grid& grid, Mesh& mesh) {
  mesh.triangles.reserve(2 * std::size_t(grid.rows - 1) * (grid.columns - 1));
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.columns; ++c) {
      const Corner top_left = corner(grid, r, c), bottom_right = corner(grid, r + 1, c + 1);
      mesh.triangles.push_back({top_left, corner(grid, r + 1, c), bottom_right});
      mesh.triangles.push_back({top_left, bottom_right, corner(grid, r, c + 1)});
    }
}

} // namespace

void build_grid(const Scene& scene, Mesh& mesh) {
  const Grid& grid = *scene.mesh.grid;
  const std::int64_t nodes = std::int64_t{grid.rows} * grid.columns;
  if (grid.rows < 1 || grid.columns < 1 || nodes < 2 || nodes > most_nodes)
    throw scene_error(scene, "mesh.grid", fmt::format("{} x {} nodes", grid.rows, grid.columns),
                      fmt::format("2 to {} nodes", most_nodes));
  place_nodes(grid, mesh);
  join_nodes(grid, steps_of(scene.mesh), mesh);
  cover(grid, mesh);
}

} // namespace hopmesh::scene
