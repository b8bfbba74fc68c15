// From the records of an OBJ to a checked surface: what says nothing is left out and told, what is broken is
// refused with its line.
#include "sim/scene/obj_file.h"

#include "sim/input/count_text.h"
#include "sim/input/input_error.h"
#include "sim/scene/obj_records.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace hopmesh::scene {

namespace {

/// Vertex -> the first vertex at its place.
std::vector<std::uint32_t> first_at_place(const std::vector<Vector3>& position) {
  std::vector<std::uint32_t> order(position.size()), first(position.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return position[a] != position[b] ? position[a] < position[b] : a < b;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && position[order[k]] == position[order[k - 1]];
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  return first;
}

class SurfaceMaker {
 public:
  SurfaceMaker(ObjRecords records, const ObjChoices& choices)
      : records_(std::move(records)), choices_(choices), first_(first_at_place(records_.position)) {}

  ObjSurface make() {
    surface_.notes = std::move(records_.notes);
    for (ObjRuns* runs : {&records_.faces, &records_.lines}) {
      check_indices(*runs);
      if (choices_.weld) weld(*runs);
    }
    drop_repeats();
    number_nodes();
    make_edges();
    make_triangles();
    return std::move(surface_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& found, const std::string& expected) const {
    throw input::input_error(records_.path, line, "", found, expected);
  }

  void note(const std::string& what) { surface_.notes.push_back(records_.path + ": " + what); }

  void check_indices(const ObjRuns& runs) const {
    const std::int64_t nodes = records_.position.size(), textures = records_.texture.size();
    for (const ObjCorner& c : runs.corner) {
      if (c.vertex >= nodes)
        fail(c.line, fmt::format("vertex {}", c.vertex + 1), fmt::format("1 to {}", nodes));
      if (c.texture >= textures)
        fail(c.line, fmt::format("texture corner {}", c.texture + 1),
             fmt::format("1 to {} (lines \"vt\")", textures));
    }
  }

  void weld(ObjRuns& runs) const {
    for (ObjCorner& c : runs.corner) c.vertex = first_[c.vertex];
  }

  void drop_repeats() {
    const std::size_t before = records_.faces.corner.size() + records_.lines.corner.size();
    const std::size_t faces = keep_distinct(records_.faces, true, 3),
                      lines = keep_distinct(records_.lines, false, 2);
    const std::size_t repeats = before - records_.faces.corner.size() - records_.lines.corner.size();
    if (repeats > 0)
      note(fmt::format("{} left out that repeat the one before, with them {} of fewer than three different "
                       "corners and {} of a single point",
                       input::with_noun(repeats, "corner"), input::with_noun(faces, "face"),
                       input::with_noun(lines, "line")));
    if (records_.faces.count() == 0 && records_.lines.count() == 0)
      fail(0, "no face of three different corners", "at least one, or a line between two vertices");
  }

  /// A corner that repeats the one before it says nothing, and a face closes by itself. Runs of fewer than
  /// `least` different vertices go; returns how many those are.
  static std::size_t keep_distinct(ObjRuns& runs, bool closed, std::size_t least) {
    ObjRuns kept;
    kept.corner.reserve(runs.corner.size());
    for (std::size_t run = 0; run < runs.count(); ++run) {
      const std::size_t first = kept.corner.size();
      for (std::size_t k = runs.begin(run); k < runs.end(run); ++k)
        if (kept.corner.size() == first || kept.corner.back().vertex != runs.corner[k].vertex)
          kept.corner.push_back(runs.corner[k]);
      while (closed && kept.corner.size() > first + 1 &&
             kept.corner.back().vertex == kept.corner[first].vertex)
        kept.corner.pop_back();
      if (different(kept.corner, first) >= least)
        kept.first.push_back(first);
      else
        kept.corner.resize(first);
    }
    const std::size_t gone = runs.count() - kept.count();
    runs = std::move(kept);
    return gone;
  }

  /// Vertices from a corner on, each counted once; exact up to three, which is all that is asked.
  static std::size_t different(const std::vector<ObjCorner>& corner, std::size_t first) {
    std::array<std::int64_t, 3> seen{-1, -1, -1};
    std::size_t count = 0;
    for (std::size_t k = first; k < corner.size() && count < seen.size(); ++k)
      if (std::find(seen.begin(), seen.end(), corner[k].vertex) == seen.end())
        seen[count++] = corner[k].vertex;
    return count;
  }

  std::vector<bool> used_vertices() const {
    std::vector<bool> used(records_.position.size());
    for (const ObjRuns* runs : {&records_.faces, &records_.lines})
      for (const ObjCorner& c : runs->corner) used[c.vertex] = true;
    return used;
  }

  /// A node without face and line has no spring: it would fall through the world and nobody would see it.
  void number_nodes() {
    const std::vector<bool> used = used_vertices();
    std::vector<std::size_t> loose;
    std::size_t welded = 0;
    node_.assign(used.size(), 0);
    for (std::size_t v = 0; v < used.size(); ++v) {
      const bool is_welded = choices_.weld && first_[v] != v, is_loose = !used[v] && !is_welded;
      if (is_welded) ++welded;
      if (is_loose) loose.push_back(v);
      if (used[v] || (is_loose && choices_.loose == Loose::keep)) add_node(v);
    }
    if (choices_.loose == Loose::keep)
      for (const std::size_t v : loose) surface_.loose.push_back(node_[v]);
    count_twins(used);
    tell_left_out(loose, welded);
  }

  void add_node(std::size_t vertex) {
    node_[vertex] = static_cast<std::uint32_t>(surface_.position.size());
    surface_.position.push_back(records_.position[vertex]);
  }

  void count_twins(const std::vector<bool>& used) {
    std::vector<bool> taken(used.size());
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      if (taken[first_[v]]) ++surface_.twins;
      taken[first_[v]] = true;
    }
  }

  void tell_left_out(const std::vector<std::size_t>& loose, std::size_t welded) {
    if (!loose.empty())
      note(fmt::format("{} in no face or line, the first in line {}: {}", vertices(loose.size()),
                       records_.vertex_line[loose[0]],
                       choices_.loose == Loose::keep
                           ? "kept, pinned where they stand"
                           : "left out, so later nodes have lower numbers than in the file (mesh.loose = "
                             "\"keep\" keeps them, pinned)"));
    if (welded > 0) note(fmt::format("{} welded to others at the same place", vertices(welded)));
  }

  static std::string vertices(std::size_t count) {
    return input::grouped(count) + (count == 1 ? " vertex" : " vertices");
  }

  void make_edges() {
    auto& edges = surface_.edges;
    edges.reserve(records_.faces.corner.size() + records_.lines.corner.size());
    for (const ObjRuns* runs : {&records_.faces, &records_.lines})
      for (std::size_t run = 0; run < runs->count(); ++run) {
        for (std::size_t k = runs->begin(run); k + 1 < runs->end(run); ++k)
          edges.push_back(edge(runs->corner[k], runs->corner[k + 1]));
        if (runs == &records_.faces)
          edges.push_back(edge(runs->corner[runs->end(run) - 1], runs->corner[runs->begin(run)]));
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  std::array<std::uint32_t, 2> edge(const ObjCorner& a, const ObjCorner& b) const {
    if (first_[a.vertex] == first_[b.vertex])
      fail(a.line, fmt::format("vertices {} and {} at one place", a.vertex + 1, b.vertex + 1),
           "edges with a length, or mesh.weld = true");
    const std::uint32_t from = node_[a.vertex], to = node_[b.vertex];
    return {std::min(from, to), std::max(from, to)};
  }

  void make_triangles() {
    const ObjRuns& faces = records_.faces;
    surface_.triangles.reserve(faces.corner.size());
    for (std::size_t f = 0; f < faces.count(); ++f)
      for (std::size_t k = faces.begin(f) + 1; k + 1 < faces.end(f); ++k)
        add_triangle(faces.corner[faces.begin(f)], faces.corner[k], faces.corner[k + 1]);
  }

  /// Of a polygon that comes by a vertex twice, some triangles have no area.
  void add_triangle(const ObjCorner& a, const ObjCorner& b, const ObjCorner& c) {
    if (a.vertex == b.vertex || a.vertex == c.vertex) return;
    surface_.triangles.push_back({finished(a), finished(b), finished(c)});
  }

  Corner finished(const ObjCorner& c) const {
    if (c.texture < 0) return {node_[c.vertex], 0, 0};
    return {node_[c.vertex], records_.texture[c.texture][0], records_.texture[c.texture][1]};
  }

  ObjRecords records_;
  const ObjChoices choices_;
  const std::vector<std::uint32_t> first_; ///< of each vertex: first_at_place
  std::vector<std::uint32_t> node_;        ///< of each vertex that became one
  ObjSurface surface_;
};

} // namespace

ObjSurface read_obj(const std::string& path, const ObjChoices& choices) {
  return SurfaceMaker(read_obj_records(path), choices).make();
}

} // namespace hopmesh::scene
