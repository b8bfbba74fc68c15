#include "sim/pictures/svg_bars.h"

#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::pictures {

namespace {

constexpr Box whole{84, 104, 554, 420}, alone{650, 104, 1120, 420};
constexpr double wide = whole.right - whole.left;
constexpr const char *thin = "#e2e2e2", *red = "#b03a2e";

/// From the lowest end of the bars to the highest, and a little room.
Axis axis_of_stacks(const StackedBars& bars) {
  double low = 0, high = 0;
  for (std::size_t k = 0; k < bars.x.size(); ++k) {
    double up = 0, down = 0;
    for (const BarPart& part : bars.parts) (part.stacked[k] > 0 ? up : down) += part.stacked[k];
    high = std::max(high, up), low = std::min(low, down);
  }
  if (high <= low) high = low + 1;
  high += 0.05 * (high - low);
  if (low < 0) low -= 0.05 * (high - low);
  return {low, high, whole.bottom, whole.top};
}

/// 1, 2 or 5 times a power of ten: about five of them along the axis.
double step_along(const Axis& axis) {
  const double least = (axis.high - axis.low) / 5, power = std::pow(10, std::floor(std::log10(least)));
  return power * (power >= least ? 1 : 2 * power >= least ? 2 : 5 * power >= least ? 5 : 10);
}

/// Whole decades.
Axis axis_of_lengths(const StackedBars& bars) {
  std::vector<double> all = bars.floor;
  for (const BarPart& part : bars.parts) all.insert(all.end(), part.length.begin(), part.length.end());
  all.erase(std::remove_if(all.begin(), all.end(), [](double v) { return !(v > 0); }), all.end());
  if (all.empty()) return {-1, 0, alone.bottom, alone.top, true};
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const double first = std::floor(std::log10(*least));
  return {first, std::max(first + 1, std::ceil(std::log10(*most))), alone.bottom, alone.top, true};
}

class BarDrawing : public SvgCanvas {
 public:
  explicit BarDrawing(const StackedBars& bars)
      : SvgCanvas(1180, 520, whole.left, bars.title, bars.note), bars_(bars) {
    draw_stacks(axis_of_stacks(bars));
    draw_lengths(axis_of_lengths(bars));
    double x = whole.left;
    for (std::size_t p = 0; p < bars.parts.size(); ++p) x = name(x, 494, chart_colour(p), bars.parts[p].name);
    name(x, 494, red, bars.floor_name);
  }

 private:
  /// The middle of a place in a panel, from its left edge.
  double middle(std::size_t k) const { return wide * (double(k) + 0.5) / double(bars_.x.size()); }

  void draw_frame(const Box& box, const std::string& heading, const std::string& y_label) {
    frame(box, heading, bars_.x_label, y_label);
    for (std::size_t k = 0; k < bars_.x.size(); ++k)
      number_x(box, box.left + middle(k), fmt::format("{:.3g}", bars_.x[k]));
  }

  void draw_stacks(const Axis& axis) {
    const double step = step_along(axis);
    for (int k = int(std::ceil(axis.low / step)); k * step <= axis.high; ++k)
      number_y(whole, axis.at(k * step), fmt::format("{:.3g}", k * step), k == 0 ? "#222" : thin);
    for (std::size_t k = 0; k < bars_.x.size(); ++k) draw_stack(axis, k);
    draw_frame(whole, bars_.stacked_title, bars_.y_label);
  }

  void draw_stack(const Axis& axis, std::size_t k) {
    const double bar = 0.62 * wide / double(bars_.x.size());
    double up = 0, down = 0;
    for (std::size_t p = 0; p < bars_.parts.size(); ++p) {
      const double value = bars_.parts[p].stacked[k];
      double& end = value > 0 ? up : down;
      const double from = axis.at(std::max(end, end + value)), to = axis.at(std::min(end, end + value));
      end += value;
      put(R"(<rect class="bar" x="{}" y="{}" width="{}" height="{}" fill="{}"><title>{}</title></rect>)",
          whole.left + middle(k) - bar / 2, from, bar, to - from, chart_colour(p), tip(p, value));
    }
  }

  void draw_lengths(const Axis& axis) {
    for (int exponent = int(axis.low); exponent <= int(axis.high); ++exponent)
      number_y(alone, axis.at(std::pow(10, exponent)), power_of_ten(exponent), thin);
    for (std::size_t p = 0; p < bars_.parts.size(); ++p) {
      draw_curve(axis, bars_.parts[p].length, chart_colour(p), "");
      for (std::size_t k = 0; k < bars_.x.size(); ++k) draw_dot(axis, p, k);
    }
    draw_curve(axis, bars_.floor, red, "8 4");
    draw_frame(alone, bars_.length_title, "");
  }

  void draw_curve(const Axis& axis, const std::vector<double>& values, const char* colour,
                  const char* dashes) {
    Points points;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k] > 0) points.emplace_back(alone.left + middle(k), axis.at(values[k]));
    put(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.6" stroke-dasharray="{}"/>)",
        path_through(points), colour, dashes);
  }

  void draw_dot(const Axis& axis, std::size_t p, std::size_t k) {
    const double value = bars_.parts[p].length[k];
    if (value > 0)
      put(R"(<circle cx="{}" cy="{}" r="4" fill="{}"><title>{}</title></circle>)", alone.left + middle(k),
          axis.at(value), chart_colour(p), tip(p, value));
  }

  std::string tip(std::size_t p, double value) const {
    return fmt::format("{}: {:.3g}", escaped(bars_.parts[p].name), value);
  }

  const StackedBars& bars_;
};

} // namespace

std::string svg_of(const StackedBars& bars) {
  return BarDrawing(bars).finish();
}

} // namespace hopmesh::pictures
