#include "sim/pictures/mesh_bitmap.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::pictures {
namespace {

class Canvas {
 public:
  Canvas(double width, double height, std::uint32_t zoom) : zoom_(zoom) {
    picture_.width = static_cast<std::uint32_t>(width) * zoom;
    picture_.height = static_cast<std::uint32_t>(height) * zoom;
    const std::size_t pixels = std::size_t{picture_.width} * picture_.height;
    picture_.rgba.assign(pixels * 4, 255);
    nearest_.assign(pixels, -INFINITY);
  }

  files::Picture take() { return std::move(picture_); }

  void draw(const Shape& shape) {
    if (shape.point.size() == 3)
      face(large(shape.point[0]), large(shape.point[1]), large(shape.point[2]), shape.colour);
    else if (shape.point.size() == 2)
      line(large(shape.point[0]), large(shape.point[1]), shape.colour);
    else
      dot(large(shape.point[0]), shape.size / 2 * zoom_, shape.colour);
  }

  /// What lies behind everything.
  void outline(const Shape& shape, std::uint32_t colour) {
    for (std::size_t k = 0; k < shape.point.size(); ++k) {
      Seen a = large(shape.point[k]), b = large(shape.point[(k + 1) % shape.point.size()]);
      a.nearness = b.nearness = -HUGE_VAL;
      line(a, b, colour);
    }
  }

 private:
  Seen large(const Seen& p) const { return {p.x * zoom_, p.y * zoom_, p.nearness}; }

  void put(std::int64_t x, std::int64_t y, double nearness, std::uint32_t colour) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    const std::size_t at = static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x);
    if (nearness < nearest_[at]) return;
    nearest_[at] = nearness;
    for (unsigned k = 0; k < 3; ++k)
      picture_.rgba[4 * at + k] = static_cast<std::uint8_t>(colour >> (16 - 8 * k) & 255u);
  }

  // Every pixel whose middle is inside; shared edges leave no gap.
  void face(const Seen& a, const Seen& b, const Seen& c, std::uint32_t colour) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    for (auto y = std::llround(top); static_cast<double>(y) + 0.5 <= bottom; ++y)
      for (auto x = std::llround(left); static_cast<double>(x) + 0.5 <= right; ++x) {
        const double px = static_cast<double>(x) + 0.5 - a.x, py = static_cast<double>(y) + 0.5 - a.y;
        const double u = (px * (c.y - a.y) - (c.x - a.x) * py) / area,
                     v = ((b.x - a.x) * py - px * (b.y - a.y)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        put(x, y, a.nearness + u * (b.nearness - a.nearness) + v * (c.nearness - a.nearness), colour);
      }
  }

  void line(const Seen& a, const Seen& b, std::uint32_t colour) {
    const double length = std::max(std::fabs(b.x - a.x), std::fabs(b.y - a.y));
    const auto steps = static_cast<std::int64_t>(std::ceil(length));
    for (std::int64_t k = 0; k <= steps; ++k) {
      const double t = steps > 0 ? static_cast<double>(k) / static_cast<double>(steps) : 0;
      put(static_cast<std::int64_t>(std::floor(a.x + t * (b.x - a.x))),
          static_cast<std::int64_t>(std::floor(a.y + t * (b.y - a.y))),
          a.nearness == b.nearness ? a.nearness : a.nearness + t * (b.nearness - a.nearness), colour);
    }
  }

  void dot(const Seen& p, double radius, std::uint32_t colour) {
    for (double y = std::floor(p.y - radius); y <= p.y + radius; ++y)
      for (double x = std::floor(p.x - radius); x <= p.x + radius; ++x)
        if (std::hypot(x + 0.5 - p.x, y + 0.5 - p.y) <= radius)
          put(static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), p.nearness, colour);
  }

  const double zoom_;
  files::Picture picture_;
  std::vector<double> nearest_;
};

} // namespace

files::Picture bitmap_of(const MeshShapes& shapes, std::uint32_t zoom, std::uint32_t faint) {
  Canvas canvas(shapes.width(), shapes.height(), zoom);
  shapes.start([&](const Shape& shape) { canvas.outline(shape, faint); });
  shapes.end([&](const Shape& shape) { canvas.draw(shape); });
  return canvas.take();
}

} // namespace hopmesh::pictures
