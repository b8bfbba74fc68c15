// Every shape is a signed distance (negative inside) in a square of side 2, the origin in its middle, y down;
// a pixel takes a shape's colour by how much of the pixel the shape covers. Painted from the cloth upwards.
#include "sim/pictures/crest/crest.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hopmesh::pictures {
namespace {

struct Point {
  double x, y;
};
struct Colour {
  double r, g, b;
};

constexpr Colour blue_light{0.130, 0.285, 0.560}, blue_dark{0.045, 0.120, 0.320};
constexpr Colour gold_light{0.965, 0.835, 0.520}, gold{0.835, 0.640, 0.255}, gold_dark{0.520, 0.355, 0.110};
constexpr Colour navy{0.045, 0.115, 0.285}, ivory{0.985, 0.965, 0.900};

Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
double length(Point p) {
  return std::sqrt(p.x * p.x + p.y * p.y);
}
Colour mix(Colour a, Colour b, double t) {
  t = std::clamp(t, 0.0, 1.0);
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}
Colour scaled(Colour c, double s) {
  return {c.r * s, c.g * s, c.b * s};
}

double circle(Point p, Point centre, double radius) {
  return length(p - centre) - radius;
}

double segment(Point p, Point a, Point b, double half_width) {
  const Point pa = p - a, ba = b - a;
  const double along = std::clamp((pa.x * ba.x + pa.y * ba.y) / (ba.x * ba.x + ba.y * ba.y), 0.0, 1.0);
  return length({pa.x - ba.x * along, pa.y - ba.y * along}) - half_width;
}

double box(Point p, double half, double radius) {
  const Point q{std::abs(p.x) - half + radius, std::abs(p.y) - half + radius};
  return length({std::max(q.x, 0.0), std::max(q.y, 0.0)}) + std::min(std::max(q.x, q.y), 0.0) - radius;
}

// The heater shield: upright sides above, two arcs below that meet in the point.
constexpr double shield_half = 0.54, shield_top = -0.64, shield_waist = -0.04, shield_point = 0.72;

double shield(Point p) {
  p.x = std::abs(p.x);
  // The arc's circle passes through (half, waist), upright there, and through (0, point).
  const double drop = shield_point - shield_waist;
  const double radius = (shield_half * shield_half + drop * drop) / (2 * shield_half);
  const Point arc_centre{shield_half - radius, shield_waist};
  const double side = p.y < shield_waist ? p.x - shield_half : length(p - arc_centre) - radius;
  const double top = shield_top - p.y;
  if (side > 0 && top > 0) return length({side, top});
  return std::max(side, top);
}

// The hops: rows of nodes that narrow with the shield, joined to their neighbours as springs join a flag's
// nodes.
constexpr std::array<Point, 9> nodes{{{-0.30, -0.40},
                                      {0.00, -0.40},
                                      {0.30, -0.40},
                                      {-0.30, -0.09},
                                      {0.00, -0.09},
                                      {0.30, -0.09},
                                      {-0.185, 0.205},
                                      {0.185, 0.205},
                                      {0.00, 0.445}}};
constexpr std::array<std::array<int, 2>, 16> links{{{0, 1},
                                                    {1, 2},
                                                    {0, 3},
                                                    {1, 4},
                                                    {2, 5},
                                                    {3, 4},
                                                    {4, 5},
                                                    {0, 4},
                                                    {4, 2},
                                                    {3, 6},
                                                    {4, 6},
                                                    {4, 7},
                                                    {5, 7},
                                                    {6, 7},
                                                    {6, 8},
                                                    {7, 8}}};

double distance_to_links(Point p) {
  double nearest = 9;
  for (const auto& link : links)
    nearest = std::min(nearest, segment(p, nodes[static_cast<std::size_t>(link[0])],
                                        nodes[static_cast<std::size_t>(link[1])], 0.0));
  return nearest;
}

double distance_to_nodes(Point p) {
  double nearest = 9;
  for (const Point& node : nodes) nearest = std::min(nearest, circle(p, node, 0.0));
  return nearest;
}

/// A node's three neurons: three dots, one above two.
double distance_to_neurons(Point p) {
  double nearest = 9;
  for (const Point& node : nodes)
    for (const Point offset : {Point{0, -0.034}, Point{-0.0295, 0.017}, Point{0.0295, 0.017}})
      nearest = std::min(nearest, circle(p, {node.x + offset.x, node.y + offset.y}, 0.0));
  return nearest;
}

/// One pixel while it is painted: shapes are laid over what is there.
class Brush {
 public:
  Brush(Point where, double pixel, Colour ground) : point(where), colour(ground), pixel_(pixel) {}

  void fill(double distance, Colour paint, double opacity = 1.0) {
    const double cover = std::clamp(0.5 - distance / pixel_, 0.0, 1.0);
    colour = mix(colour, paint, cover * opacity);
  }
  /// A soft dark halo that lifts the shape off its ground.
  void shadow(double distance, double width, double opacity) {
    const double t = std::clamp(1.0 - distance / width, 0.0, 1.0);
    colour = mix(colour, {0.01, 0.03, 0.09}, opacity * t * t);
  }

  Point point;
  Colour colour;

 private:
  double pixel_;
};

/// Gold as a metal: light falls from the top left, the edges turn away from it.
Colour metal(Point p, double depth) {
  const double lit = 0.5 - 0.42 * (0.55 * p.x + 0.75 * p.y);
  const Colour face = lit > 0.5 ? mix(gold, gold_light, (lit - 0.5) * 2) : mix(gold_dark, gold, lit * 2);
  return mix(scaled(face, 0.86), face, depth / 0.03);
}

Colour field(Point p) {
  return mix(blue_light, blue_dark, 0.75 * length({p.x * 0.9, p.y + 0.25}));
}

void paint_border(Brush& brush) {
  const Point p = brush.point;
  const double band = std::abs(box(p, 0.925, 0.03)) - 0.011;
  brush.shadow(band, 0.035, 0.35);
  brush.fill(band, metal(p, 0.02));
  brush.fill(std::abs(box(p, 0.885, 0.02)) - 0.0035, gold, 0.75);
}

void paint_shield(Brush& brush) {
  const Point p = brush.point;
  const double edge = shield(p);
  brush.shadow(shield({p.x - 0.012, p.y - 0.022}), 0.14, 0.55);
  brush.fill(edge, metal(p, -edge));
  brush.fill(edge + 0.032, scaled(gold_dark, 0.75));
  brush.fill(edge + 0.038, navy);
  brush.fill(edge + 0.058, scaled(gold_dark, 0.9));
  brush.fill(edge + 0.064, metal({p.x * 1.2, p.y * 1.1 - 0.25}, -edge - 0.064));
}

void paint_mesh(Brush& brush) {
  const Point p = brush.point;
  const double link = distance_to_links(p), node = distance_to_nodes(p), neuron = distance_to_neurons(p);
  brush.fill(std::min(link - 0.017, node - 0.089), gold_light, 0.65); // an engraver's bright rim
  brush.fill(link - 0.0125, navy);
  brush.fill(node - 0.084, mix(navy, blue_light, 0.5 - 4 * node));
  brush.fill(neuron - 0.0205, ivory);
}

/// Plain weave: warp and weft threads, each rounded, each over its neighbour in turn.
double weave(std::uint32_t x, std::uint32_t y) {
  constexpr double rounded[4] = {-0.5, 0.6, 0.6, -0.5};
  const bool warp_above = ((x / 4 + y / 4) & 1u) != 0;
  return 1.0 + 0.035 * (warp_above ? rounded[x % 4] + 0.25 : rounded[y % 4] - 0.25);
}

std::uint8_t byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

} // namespace

files::Picture draw_crest(std::uint32_t size) {
  files::Picture picture{size, size, {}};
  picture.rgba.reserve(std::size_t{size} * size * 4);
  const double pixel = 2.0 / size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const Point p{(x + 0.5) * pixel - 1, (y + 0.5) * pixel - 1};
      Brush brush(p, pixel, field(p));
      paint_border(brush);
      paint_shield(brush);
      paint_mesh(brush);
      const Colour c = scaled(brush.colour, weave(x, y));
      picture.rgba.insert(picture.rgba.end(), {byte(c.r), byte(c.g), byte(c.b), 255});
    }
  return picture;
}

std::string crest_png(std::uint32_t size) {
  return files::encode_png(draw_crest(size));
}

} // namespace hopmesh::pictures
