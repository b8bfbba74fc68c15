// Reads an OBJ in two walks: lines to records, then records to a checked surface (faces may stand before
// vertices).
#include "sim/scene/obj_file.h"

#include "sim/input/input_error.h"
#include "sim/input/line_reader.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"
#include "sim/scene/limits.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr double farthest = 1e15; // squares and their sums stay finite

/// A corner as written, both indices made absolute and counted from 0; texture -1: none.
struct RawCorner {
  std::int64_t vertex, texture;
  int line;
};

using input::Words;

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : path_(path) {}

  ObjSurface read() {
    read_lines(input::read_whole_file(path_, "an OBJ mesh", most_bytes));
    if (first_corner_.empty() && line_ends_.empty())
      fail(0, "no faces (lines \"f ...\")", "an OBJ mesh with at least one, or with lines \"l ...\"");
    first_corner_.push_back(corners_.size());
    check_indices(corners_);
    check_indices(line_ends_);
    check_used();
    make_edges();
    make_triangles();
    return std::move(surface_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& found, const std::string& expected) const {
    throw input::input_error(path_, line, "", found, expected);
  }

  void read_lines(const std::string& text) {
    input::LineReader lines(text);
    while (lines.next()) {
      line_ = lines.number();
      read_line(lines.line());
    }
  }

  void read_line(std::string_view line) {
    if (line.find('\0') != std::string_view::npos)
      fail(line_, "a byte of value 0", "an OBJ mesh, which is text");
    Words words(line.substr(0, line.find('#')));
    const std::string_view keyword = words.next();
    if (keyword == "v")
      read_vertex(words);
    else if (keyword == "vt")
      read_texture(words);
    else if (keyword == "f")
      read_face(words);
    else if (keyword == "l")
      read_polyline(words);
  }

  double number(std::string_view word, const char* name) const {
    double x = 0;
    if (!input::parse_number(word, x))
      fail(line_, word.empty() ? "no " + std::string(name) : input::in_quotes(word),
           fmt::format("a number for {}", name));
    if (!(std::abs(x) <= farthest))
      fail(line_, input::in_quotes(word), fmt::format("a number within 1e15 for {}", name));
    return x;
  }

  void read_vertex(Words& words) {
    const double x = number(words.next(), "x"), y = number(words.next(), "y"), z = number(words.next(), "z");
    surface_.position.push_back({x, y, z});
    vertex_line_.push_back(line_);
    if (surface_.position.size() > std::size_t(most_nodes))
      fail(line_, "one vertex more", fmt::format("at most {} nodes", most_nodes));
  }

  /// v points up in OBJ and down in pictures.
  void read_texture(Words& words) {
    const double u = number(words.next(), "u");
    const std::string_view v = words.next();
    texture_.push_back({float(u), float(1 - (v.empty() ? 0.0 : number(v, "v")))});
  }

  void read_face(Words& words) {
    first_corner_.push_back(corners_.size());
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      corners_.push_back(corner(word));
    const std::size_t count = corners_.size() - first_corner_.back();
    if (count < 3) fail(line_, fmt::format("a face of {} corners", count), "at least three");
  }

  /// l a b c: springs a-b and b-c, and nothing to see but them.
  void read_polyline(Words& words) {
    std::vector<RawCorner> points;
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      points.push_back(corner(word));
    if (points.size() < 2) fail(line_, fmt::format("a line of {} points", points.size()), "at least two");
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      line_ends_.insert(line_ends_.end(), {points[k], points[k + 1]});
  }

  /// v, v/vt, v//vn or v/vt/vn; normals are of no use to a mesh that moves.
  RawCorner corner(std::string_view word) const {
    const auto slash = word.find('/');
    RawCorner corner{index(word.substr(0, slash), surface_.position.size(), word), -1, line_};
    if (slash == std::string_view::npos) return corner;
    const std::string_view rest = word.substr(slash + 1);
    const auto second = rest.find('/');
    const std::string_view texture = rest.substr(0, second);
    if (!texture.empty())
      corner.texture = index(texture, texture_.size(), word);
    else if (second == std::string_view::npos)
      fail(line_, input::in_quotes(word), "a texture index after the /");
    if (second != std::string_view::npos && rest.find('/', second + 1) != std::string_view::npos)
      fail(line_, input::in_quotes(word), "at most v/vt/vn");
    return corner;
  }

  /// Indices count from 1; negative ones count back from the latest.
  std::int64_t index(std::string_view digits, std::size_t so_far, std::string_view word) const {
    std::int64_t k = 0;
    if (!input::parse_number(digits, k) || k == 0)
      fail(line_, input::in_quotes(word), "a corner v, v/vt, v//vn or v/vt/vn with indices from 1");
    if (k < 0 && k + std::int64_t(so_far) < 0)
      fail(line_, input::in_quotes(word), fmt::format("at most {} back, that many stand above", so_far));
    return k > 0 ? k - 1 : k + std::int64_t(so_far);
  }

  void check_indices(const std::vector<RawCorner>& corners) const {
    const std::int64_t nodes = surface_.position.size(), textures = texture_.size();
    for (const RawCorner& c : corners) {
      if (c.vertex >= nodes)
        fail(c.line, fmt::format("vertex {}", c.vertex + 1), fmt::format("1 to {}", nodes));
      if (c.texture >= textures)
        fail(c.line, fmt::format("texture corner {}", c.texture + 1),
             fmt::format("1 to {} (lines \"vt\")", textures));
    }
  }

  /// A node without face and line has no spring: it would fall through the world and nobody would see it.
  void check_used() const {
    std::vector<bool> used(surface_.position.size());
    for (const auto* corners : {&corners_, &line_ends_})
      for (const RawCorner& c : *corners) used[c.vertex] = true;
    const auto lost = std::find(used.begin(), used.end(), false);
    if (lost == used.end()) return;
    const auto node = lost - used.begin();
    fail(vertex_line_[node], fmt::format("vertex {} in no face", node + 1),
         "only vertices that faces or lines use");
  }

  void make_edges() {
    auto& edges = surface_.edges;
    edges.reserve(corners_.size() + line_ends_.size() / 2);
    for (std::size_t f = 0; f + 1 < first_corner_.size(); ++f)
      for (std::size_t k = first_corner_[f]; k < first_corner_[f + 1]; ++k)
        edges.push_back(edge(corners_[k], corners_[k + 1 < first_corner_[f + 1] ? k + 1 : first_corner_[f]]));
    for (std::size_t k = 0; k < line_ends_.size(); k += 2)
      edges.push_back(edge(line_ends_[k], line_ends_[k + 1]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  std::array<std::uint32_t, 2> edge(const RawCorner& a, const RawCorner& b) const {
    if (a.vertex == b.vertex)
      fail(a.line, fmt::format("vertex {} twice in a row", a.vertex + 1), "two ends of an edge");
    if (surface_.position[a.vertex] == surface_.position[b.vertex])
      fail(a.line, fmt::format("vertices {} and {} at one place", a.vertex + 1, b.vertex + 1),
           "edges with a length");
    return {std::uint32_t(std::min(a.vertex, b.vertex)), std::uint32_t(std::max(a.vertex, b.vertex))};
  }

  void make_triangles() {
    surface_.triangles.reserve(corners_.size());
    for (std::size_t f = 0; f + 1 < first_corner_.size(); ++f)
      for (std::size_t k = first_corner_[f] + 1; k + 1 < first_corner_[f + 1]; ++k)
        surface_.triangles.push_back(
            {finished(corners_[first_corner_[f]]), finished(corners_[k]), finished(corners_[k + 1])});
  }

  Corner finished(const RawCorner& c) const {
    if (c.texture < 0) return {std::uint32_t(c.vertex), 0, 0};
    return {std::uint32_t(c.vertex), texture_[c.texture][0], texture_[c.texture][1]};
  }

  std::string path_;
  int line_ = 0;
  ObjSurface surface_;
  std::vector<int> vertex_line_;
  std::vector<std::array<float, 2>> texture_;
  std::vector<RawCorner> corners_;        ///< of faces
  std::vector<RawCorner> line_ends_;      ///< two a spring
  std::vector<std::size_t> first_corner_; ///< of each face, and the end
};

} // namespace

ObjSurface read_obj(const std::string& path) {
  return ObjReader(path).read();
}

} // namespace hopmesh::scene
