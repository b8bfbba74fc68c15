// Scene -> mesh: shape, pins, rest lengths, and the rules that only a whole mesh can break.
#include "sim/scene/mesh.h"

#include "sim/scene/mesh_parts.h"
#include "sim/scene/obj_file.h"
#include "sim/scene/scene_reader.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

/// By sqrt, which rounds alike on every machine; hypot does not.
double distance(const Vector3& a, const Vector3& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// A constant tension knows no rest length. Its floor is a thousandth of the mean spring unless told: far
/// below what a picture shows, and short springs still weigh little more than the others.
void set_tension(const Scene& scene, Mesh& mesh) {
  mesh.law = SpringLaw::tension;
  double sum = 0;
  for (const Spring& s : mesh.springs) sum += distance(mesh.position[s.node[0]], mesh.position[s.node[1]]);
  mesh.floor = scene.mesh.floor.value_or(1e-3 * sum / static_cast<double>(mesh.springs.size()));
}

void set_rest_lengths(const Scene& scene, Mesh& mesh) {
  for (Spring& s : mesh.springs) {
    s.rest_length = scene.mesh.rest.value_or(distance(mesh.position[s.node[0]], mesh.position[s.node[1]]));
    if (!scene.mesh.rest && s.rest_length == 0)
      throw scene_error(scene, "mesh.rest",
                        fmt::format("no length between nodes {} and {}", s.node[0], s.node[1]),
                        "springs with a natural length");
  }
}

void check_planar(const Scene& scene, const Mesh& mesh) {
  if (!scene.mesh.planar) return;
  for (std::size_t i = 1; i < mesh.nodes(); ++i)
    if (mesh.position[i][1] != mesh.position[0][1])
      throw scene_error(scene, "mesh.planar", fmt::format("node {} at y = {}", i, mesh.position[i][1]),
                        fmt::format("the whole mesh at one y, as node 0 at {}", mesh.position[0][1]));
}

/// beta_i is a mean over a node's springs: a free node must have one.
void check_free_nodes(const Scene& scene, const Mesh& mesh) {
  std::vector<bool> held(mesh.pinned);
  for (const Spring& s : mesh.springs) held[s.node[0]] = held[s.node[1]] = true;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i])
      throw scene_error(scene, "mesh.springs", fmt::format("free node {} without a spring", i),
                        "a spring at every one");
}

void check_motion(const Scene& scene, const Mesh& mesh) {
  if (mesh.springs.empty())
    throw scene_error(scene, "mesh.springs", "no spring", "at least one kind above 0");
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (!mesh.pinned[i]) return check_free_nodes(scene, mesh);
  throw scene_error(scene, "mesh.pinned", fmt::format("all {} nodes pinned", mesh.nodes()),
                    "at least one free node");
}

/// What no pin holds can go anywhere without a spring being longer: there is no least energy to find.
void check_held(const Scene& scene, const Mesh& mesh) {
  if (!scene.is_static()) return;
  const auto part = parts_of(mesh);
  std::vector<bool> held(mesh.nodes());
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.pinned[i]) held[part[i]] = true;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (!held[part[i]])
      throw scene_error(scene, "mesh.pinned", fmt::format("no pin in the part of node {}", i),
                        "a pinned node in every part of the mesh, for incremental.rule = \"static\"");
}

} // namespace

FileFacts build_from_file(const Scene& scene, Mesh& mesh) {
  const std::string path = scene.mesh.file.value_or("");
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw scene_error(scene, "mesh.file", "no file " + path,
                      "the OBJ mesh of this scene: put it there, or name yours with --set mesh.file=PATH");
  ObjSurface surface = read_obj(path, {scene.mesh.loose, scene.mesh.weld});
  for (Vector3& x : surface.position)
    for (double& component : x) component *= scene.mesh.scale;
  mesh.position = std::move(surface.position);
  mesh.triangles = std::move(surface.triangles);
  mesh.notes = std::move(surface.notes);
  mesh.springs.reserve(surface.edges.size());
  for (const auto& edge : surface.edges)
    if (scene.mesh.structural != 0) mesh.springs.push_back({{edge[0], edge[1]}, scene.mesh.structural, 0});
  return {std::move(surface.loose), surface.twins};
}

Mesh build_mesh(const Scene& scene) {
  Mesh mesh;
  mesh.mass = scene.mesh.mass;
  mesh.planar = scene.mesh.planar;
  FileFacts facts;
  if (scene.mesh.grid)
    build_grid(scene, mesh);
  else
    facts = build_from_file(scene, mesh);
  pin_nodes(scene, mesh);
  for (const std::uint32_t node : facts.loose) mesh.pinned[node] = true;
  if (scene.mesh.law == SpringLaw::tension)
    set_tension(scene, mesh);
  else
    set_rest_lengths(scene, mesh);
  check_planar(scene, mesh);
  check_motion(scene, mesh);
  check_held(scene, mesh);
  if (scene.mesh.file) note_surprises(scene, facts, mesh);
  mesh.velocity = scene.mesh.start.velocity;
  if (scene.mesh.start.shuffle > 0) shuffle_nodes(scene.mesh.start, mesh);
  return mesh;
}

} // namespace hopmesh::scene
