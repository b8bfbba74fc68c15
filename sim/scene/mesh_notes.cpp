// What a mesh file may do that nobody asked for, told before it moves.
#include "sim/input/count_text.h"
#include "sim/scene/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

constexpr double far_shorter = 1e-6; // than the mean spring

struct Parts {
  std::size_t all = 0, without_pin = 0;
};

/// Nodes without a spring are no part of their own.
Parts count_parts(const Mesh& mesh) {
  const auto part = parts_of(mesh);
  std::vector<bool> has_spring(mesh.nodes()), has_pin(mesh.nodes());
  for (const Spring& s : mesh.springs) has_spring[part[s.node[0]]] = true;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.pinned[i]) has_pin[part[i]] = true;
  Parts parts;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    if (part[i] != i || !has_spring[i]) continue;
    ++parts.all;
    if (!has_pin[i]) ++parts.without_pin;
  }
  return parts;
}

std::string words_of(const Parts& parts) {
  const std::string all = input::grouped(parts.all) + " parts that no spring joins";
  return parts.without_pin > 0
             ? fmt::format("{}, {} of them without a pin", all, input::grouped(parts.without_pin))
             : all;
}

std::string words_of_seams(std::size_t twins) {
  return fmt::format(
      "{} at a place where another one stands, not joined to it: seams that open (mesh.weld = true "
      "joins them)",
      input::with_noun(twins, "node"));
}

void note_short_spring(const Scene& scene, Mesh& mesh) {
  const auto length = [&](const Spring& s) {
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = mesh.position[s.node[0]][k] - mesh.position[s.node[1]][k];
      squares += d * d;
    }
    return std::sqrt(squares);
  };
  double sum = 0;
  for (const Spring& s : mesh.springs) sum += length(s);
  const double mean = sum / static_cast<double>(mesh.springs.size());
  const auto shortest =
      std::min_element(mesh.springs.begin(), mesh.springs.end(),
                       [&](const Spring& a, const Spring& b) { return length(a) < length(b); });
  if (length(*shortest) >= far_shorter * mean) return;
  mesh.notes.push_back(fmt::format(
      "{}: the spring of nodes {} and {} is {:.3g} m long, the mean spring {:.3g} m: "
      "its strain and stretch may be huge",
      scene.mesh.file.value_or(""), shortest->node[0], shortest->node[1], length(*shortest), mean));
}

} // namespace

std::vector<std::uint32_t> parts_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.nodes());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto top = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Spring& s : mesh.springs) parent[top(s.node[0])] = top(s.node[1]);
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = top(i);
  return parent;
}

void note_surprises(const Scene& scene, const FileFacts& facts, Mesh& mesh) {
  const Parts parts = count_parts(mesh);
  std::string words = parts.all > 1 ? words_of(parts) : "";
  if (facts.twins > 0) words += (words.empty() ? "" : "; ") + words_of_seams(facts.twins);
  if (!words.empty()) mesh.notes.push_back(scene.mesh.file.value_or("") + ": " + words);
  note_short_spring(scene, mesh);
}

} // namespace hopmesh::scene
