#include "sim/pictures/mesh_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hopmesh::pictures {
namespace {

constexpr double widest = 640, highest = 480, least = 160, margin = 24;
constexpr std::size_t most_small = 300;   ///< nodes of a net of lines that get a dot each
constexpr std::size_t most_skin = 10'000; ///< triangles of a mesh that is asked whether it is a solid
constexpr std::uint32_t front = 0x4f93dc, back = 0xdfb566, line = 0x1f5fa8, pinned = 0xc22f1d;

// Turned by 30 degrees about its upright, then tilted by 20: constants, so that a picture is the same
// everywhere.
constexpr double turn_cos = 0.8660254, turn_sin = 0.5, tilt_cos = 0.9396926, tilt_sin = 0.3420201;

/// The least and the largest of what is finite.
struct Extent {
  double least = INFINITY, largest = -INFINITY;
  void add(double value) { least = std::min(least, value), largest = std::max(largest, value); }
  double size() const { return largest > least ? largest - least : 0; }
  double middle() const { return largest >= least ? least / 2 + largest / 2 : 0; }
};

bool finite(const Seen& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.nearness);
}

bool all_finite(const Shape& shape) {
  return std::all_of(shape.point.begin(), shape.point.end(), finite);
}

Floats upright(const RunView& view, std::size_t frame) {
  Surface nodes;
  nodes.node.resize(view.nodes);
  std::iota(nodes.node.begin(), nodes.node.end(), 0u);
  return positions_of(view, nodes, frame);
}

/// True where two triangles meet at every edge and walk it in opposite directions.
bool has_no_rim(const RunView& view) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> there, reversed;
  for (const auto& t : view.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      there.emplace_back(t[k].node, t[(k + 1) % 3].node);
      reversed.emplace_back(there.back().second, there.back().first);
    }
  std::sort(there.begin(), there.end());
  std::sort(reversed.begin(), reversed.end());
  return !there.empty() && there == reversed && std::adjacent_find(there.begin(), there.end()) == there.end();
}

/// Six times the volume that the triangles enclose, fronts outside.
double volume(const RunView& view, const Floats& at) {
  double sum = 0;
  for (const auto& t : view.triangles) {
    const float *a = &at[t[0].node * 3], *b = &at[t[1].node * 3], *c = &at[t[2].node * 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      sum += double{a[k]} * (double{b[l]} * double{c[m]} - double{b[m]} * double{c[l]});
    }
  }
  return sum;
}

/// The colour of a face under light from the upper left; backs have a colour of their own.
std::uint32_t lit(const Seen& a, const Seen& b, const Seen& c) {
  const double u[3] = {b.x - a.x, a.y - b.y, b.nearness - a.nearness},
               v[3] = {c.x - a.x, a.y - c.y, c.nearness - a.nearness};
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double towards = size > 0 ? std::fabs(-0.35 * n[0] + 0.55 * n[1] + 0.76 * n[2]) / size : 1;
  const double light = std::min(1.0, 0.4 + 0.6 * towards);
  const std::uint32_t colour = n[2] >= 0 ? front : back;
  std::uint32_t result = 0;
  for (const unsigned shift : {16u, 8u, 0u})
    result |= static_cast<std::uint32_t>(light * static_cast<double>(colour >> shift & 255u)) << shift;
  return result;
}

} // namespace

double Shape::nearness() const {
  double sum = 0;
  for (const Seen& p : point) sum += p.nearness;
  return sum / static_cast<double>(point.size());
}

MeshShapes::MeshShapes(const RunView& view)
    : view_(view), start_(upright(view, 0)), end_(upright(view, view.frames.size() - 1)),
      on_face_(view.nodes, false) {
  for (const auto& triangle : view.triangles)
    for (const ViewCorner& corner : triangle) on_face_[corner.node] = true;
  solid_ = view.triangles.size() <= most_skin && has_no_rim(view) && volume(view, start_) > 0;
  look();
}

// Scale and middle are such that start and end are both on the paper.
void MeshShapes::look() {
  Extent axis[3], x, y;
  for (const Floats* frame : {&start_, &end_})
    for (std::size_t k = 0; k < frame->size(); ++k)
      if (std::isfinite((*frame)[k])) axis[k % 3].add(double{(*frame)[k]});
  flat_ = axis[2].size() <= 1e-6 * std::max(axis[0].size(), axis[1].size());
  for (const Floats* frame : {&start_, &end_})
    for (std::size_t n = 0; n < view_.nodes; ++n) {
      const Seen p = seen(*frame, n);
      if (finite(p)) x.add(p.x), y.add(p.y);
    }
  scale_ = std::min((widest - 2 * margin) / x.size(), (highest - 2 * margin) / y.size());
  if (!std::isfinite(scale_)) scale_ = 0; // all in one place
  middle_ = {x.middle(), y.middle(), 0};
  width_ = std::max(least, std::round(x.size() * scale_ + 2 * margin));
  height_ = std::max(least, std::round(y.size() * scale_ + 2 * margin));
}

Seen MeshShapes::seen(const Floats& frame, std::size_t node) const {
  const float* p = frame.data() + node * 3;
  const double x = p[0], y = p[1], z = p[2];
  if (flat_) return {x, y, z};
  const double across = turn_cos * x - turn_sin * z, towards = turn_sin * x + turn_cos * z;
  return {across, tilt_cos * y - tilt_sin * towards, tilt_sin * y + tilt_cos * towards};
}

Seen MeshShapes::on_paper(const Floats& frame, std::size_t node) const {
  const Seen p = seen(frame, node);
  return {width_ / 2 + (p.x - middle_.x) * scale_, height_ / 2 - (p.y - middle_.y) * scale_,
          p.nearness * scale_};
}

void MeshShapes::start(const Draw& draw) const {
  if (start_ != end_) faces(start_, draw), lines(start_, draw);
}

void MeshShapes::end(const Draw& draw) const {
  faces(end_, draw), lines(end_, draw), dots(draw);
}

void MeshShapes::faces(const Floats& frame, const Draw& draw) const {
  Shape face{std::vector<Seen>(3), 0, 0};
  for (const auto& triangle : view_.triangles) {
    for (std::size_t k = 0; k < 3; ++k) face.point[k] = on_paper(frame, triangle[k].node);
    const Seen &a = face.point[0], &b = face.point[1], &c = face.point[2];
    if (solid_ && (b.x - a.x) * (a.y - c.y) < (a.y - b.y) * (c.x - a.x)) continue; // its back
    face.colour = lit(a, b, c);
    if (all_finite(face)) draw(face);
  }
}

// A spring on faces is drawn only where both of its ends are pinned: a wire, a pole, a rim. Lines stand a
// little nearer than the faces, and dots nearer than the lines.
void MeshShapes::lines(const Floats& frame, const Draw& draw) const {
  Shape shape{std::vector<Seen>(2), 0, 2};
  for (const ViewSpring& s : view_.springs) {
    const bool rim = view_.pinned[s.node[0]] && view_.pinned[s.node[1]];
    if (!rim && on_face_[s.node[0]] && on_face_[s.node[1]]) continue;
    for (std::size_t k = 0; k < 2; ++k)
      shape.point[k] = on_paper(frame, s.node[k]), shape.point[k].nearness += 1;
    shape.colour = rim ? pinned : line;
    if (all_finite(shape)) draw(shape);
  }
}

// Dots are drawn at pinned nodes, and at every node of a small net of lines.
void MeshShapes::dots(const Draw& draw) const {
  const bool every = view_.triangles.empty() && view_.nodes <= most_small;
  for (std::size_t n = 0; n < view_.nodes; ++n) {
    if (!view_.pinned[n] && !every) continue;
    Shape dot{{on_paper(end_, n)}, view_.pinned[n] ? pinned : line, view_.pinned[n] && every ? 4.5 : 3.0};
    dot.point[0].nearness += 2;
    if (all_finite(dot)) draw(dot);
  }
}

} // namespace hopmesh::pictures
