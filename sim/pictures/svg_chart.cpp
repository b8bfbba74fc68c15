#include "sim/pictures/svg_chart.h"

#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hopmesh::pictures {

namespace {

constexpr Box plot{92, 74, 800, 560};
constexpr double failed_at = plot.right - 14, rightmost = plot.right - 34; // a strip is left for what failed
constexpr double note_height = 18, letter_width = 6.4, label_height = 12;

bool drawable(const ChartPoint& p) {
  return p.y > 0 && std::isfinite(p.y) && (p.failed || (p.x > 0 && std::isfinite(p.x)));
}

bool has_mark(const ChartSeries& series) {
  for (const auto& ladder : series.ladders)
    if (std::any_of(ladder.begin(), ladder.end(), drawable)) return true;
  return false;
}

bool has_failed(const Chart& chart) {
  const auto failed = [](const ChartPoint& p) { return p.failed && drawable(p); };
  for (const ChartSeries& series : chart.series)
    for (const auto& ladder : series.ladders)
      if (std::any_of(ladder.begin(), ladder.end(), failed)) return true;
  return false;
}

std::vector<std::string> notes_of(const Chart& chart) {
  std::ptrdiff_t left_out = 0;
  for (const ChartSeries& series : chart.series)
    for (const auto& ladder : series.ladders)
      left_out += std::count_if(ladder.begin(), ladder.end(), [](const auto& p) { return !drawable(p); });
  std::vector<std::string> notes = chart.notes;
  if (left_out > 0)
    notes.push_back(fmt::format("{} points have no place here (a zero or an empty cell)", left_out));
  return notes;
}

double height_for(std::size_t notes) {
  return 660 + note_height * static_cast<double>(notes > 1 ? notes - 1 : 0);
}

/// Room of a fifth of a decade at both ends, and a decade in all at least.
Axis axis_over(const std::vector<double>& values, double from, double to) {
  if (values.empty()) return {0, 1, from, to, true};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = std::log10(*least) - 0.2, high = std::log10(*most) + 0.2;
  const double missing = std::max(0.0, 1 - (high - low));
  return {low - missing / 2, high + missing / 2, from, to, true};
}

class ChartDrawing : public SvgCanvas {
 public:
  explicit ChartDrawing(const Chart& chart)
      : SvgCanvas(1100, height_for(notes_of(chart).size()), plot.left, chart.title,
                  chart.curves ? "lower left is better"
                               : "lower left is better; dashed: nobody is better in both"),
        chart_(chart) {
    find_axes();
    draw_grid(x_, true), draw_grid(y_, false);
    frame(plot, "", chart.x_label, chart.y_label);
    if (chart.guides && !chart.curves) draw_guides();
    for (const ChartLine& line : chart.lines)
      if (line.x > 0) draw_line(line);
    if (!chart.curves) draw_front();
    const std::size_t count = chart.series.size();
    for (std::size_t s = 0; s < count; ++s) draw_series(chart.curves ? count - 1 - s : s); // the first on top
    draw_labels();
    draw_legend();
    draw_notes();
  }

 private:
  void find_axes() {
    std::vector<double> xs, ys;
    for (const ChartSeries& series : chart_.series)
      for (const auto& ladder : series.ladders)
        for (const ChartPoint& p : ladder) {
          if (drawable(p)) ys.push_back(p.y), add_ends(p.up, ys);
          if (drawable(p) && !p.failed) xs.push_back(p.x), add_ends(p.across, xs), good_.push_back(p);
        }
    for (const ChartLine& line : chart_.lines)
      if (line.x > 0) xs.push_back(line.x);
    x_ = axis_over(xs, plot.left, rightmost), y_ = axis_over(ys, plot.bottom, plot.top);
  }

  static void add_ends(const ChartBar& bar, std::vector<double>& values) {
    for (const double end : {bar.least, bar.largest})
      if (end > 0 && std::isfinite(end)) values.push_back(end);
  }

  void draw_notes() {
    double y = plot.bottom + 72;
    for (const std::string& note : notes_of(chart_))
      text(plot.left, y, note, R"( fill="#666")"), y += note_height;
  }

  // A line a decade, thin ones at 2..9, and numbers where decades are.
  void draw_grid(const Axis& axis, bool along_x) {
    for (int decade = int(std::floor(axis.low)); decade <= int(std::ceil(axis.high)); ++decade)
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * std::pow(10, decade), at = axis.at(value);
        if (std::log10(value) < axis.low || std::log10(value) > axis.high) continue;
        const bool told = digit == 1 || (axis.high - axis.low < 2 && (digit == 2 || digit == 5));
        const std::string number = !told                       ? ""
                                   : decade < -2 || decade > 3 ? power_of_ten(decade, digit)
                                                               : fmt::format("{:g}", value);
        const char* colour = digit == 1 ? "#d4d4d4" : "#f1f1f1";
        along_x ? number_x(plot, at, number, colour) : number_y(plot, at, number, colour);
      }
  }

  // From the middle of the plot: halving the error costs 2^(1/p) times the work at order p.
  void draw_guides() {
    const double x0 = (x_.low + x_.high) / 2, y0 = (y_.low + y_.high) / 2;
    for (int order : {1, 2, 4}) {
      const double reach = std::min((x_.high - x_.low) / 2, (y_.high - y0) * order); // to the plot's edge
      const auto spot = [&](double part) {
        return std::pair(x_.at(std::pow(10, x0 - part * reach)),
                         y_.at(std::pow(10, y0 + part * reach / order)));
      };
      put(R"(<path d="{}" stroke="#c9c9c9" stroke-dasharray="2 4"/>)", path_through({spot(1), spot(-1)}));
      text(spot(0.92).first + 5, spot(0.92).second - 3, fmt::format("order {}", order),
           R"( font-size="11" fill="#999")");
    }
  }

  void draw_line(const ChartLine& line) {
    const double x = x_.at(line.x);
    put(R"(<path d="M{} {}V{}" stroke="#b03a2e" stroke-width="1.5" stroke-dasharray="8 4"/>)", x, plot.top,
        plot.bottom);
    upright(x - 5, plot.bottom - 8, line.name, R"( font-size="11" fill="#b03a2e")"); // there is least work
  }

  void draw_front() {
    Points steps;
    for (const ChartPoint& p : pareto_front(good_)) {
      if (!steps.empty()) steps.emplace_back(x_.at(p.x), steps.back().second);
      steps.emplace_back(x_.at(p.x), y_.at(p.y));
    }
    put(R"(<path class="front" d="{}" fill="none" stroke="#222" stroke-width="1.3" stroke-dasharray="5 4"/>)",
        path_through(steps));
  }

  void draw_series(std::size_t index) {
    for (const auto& ladder : chart_.series[index].ladders) {
      Points points;
      for (const ChartPoint& p : ladder)
        if (drawable(p) && !p.failed) points.emplace_back(x_.at(p.x), y_.at(p.y));
      put(R"(<path d="{}" fill="none" {}/>)", path_through(points), stroke(index));
    }
    for (const auto& ladder : chart_.series[index].ladders)
      for (const ChartPoint& p : ladder)
        if (drawable(p) && (!chart_.curves || &p == &ladder.back()))
          draw_mark(p, chart_.series[index].squares, chart_colour(index));
  }

  // Neighbours in the list of curves differ in dashes as well as in colour.
  std::string stroke(std::size_t index) const {
    static constexpr const char* dashes[] = {"none", "8 3", "2 3", "9 3 2 3"};
    if (!chart_.curves)
      return fmt::format(R"(stroke="{}" stroke-width="1.6" opacity="0.55")", chart_colour(index));
    return fmt::format(R"(stroke="{}" stroke-width="{}" stroke-linejoin="round" stroke-dasharray="{}")",
                       chart_colour(index), index == 0 ? 4 : 2, dashes[index % std::size(dashes)]);
  }

  // An end at 0 has no place: its bar goes to the edge.
  void draw_bars(const ChartPoint& p, const char* colour) {
    const double x = x_.at(p.x), y = y_.at(p.y);
    if (p.across.largest > p.across.least && !p.failed)
      put(R"(<path class="bar" d="M{} {}H{}" stroke="{}" stroke-width="1.6"/>)",
          p.across.least > 0 ? x_.at(p.across.least) : plot.left, y, x_.at(p.across.largest), colour);
    if (p.up.largest > p.up.least)
      put(R"(<path class="bar" d="M{} {}V{}" stroke="{}" stroke-width="1.6"/>)", p.failed ? failed_at : x,
          p.up.least > 0 ? y_.at(p.up.least) : plot.bottom, y_.at(p.up.largest), colour);
  }

  void draw_mark(const ChartPoint& p, bool square, const char* colour) {
    draw_bars(p, colour);
    const double x = p.failed ? failed_at : x_.at(p.x), y = y_.at(p.y);
    put(R"(<{} fill="{}" stroke="{}" stroke-width="1.6" class="{}" data-command="{}"><title>{}</title></{}>)",
        mark_at(square, x, y), p.failed ? "#fff" : colour, p.failed ? colour : "#fff",
        p.failed ? "point failed" : "point", escaped(p.command), escaped(p.tip + '\n' + p.command),
        square ? "rect" : "circle");
  }

  static std::string mark_at(bool square, double x, double y) {
    return square ? fmt::format(R"(rect x="{:.1f}" y="{:.1f}" width="10" height="10")", x - 5, y - 5)
                  : fmt::format(R"(circle cx="{:.1f}" cy="{:.1f}" r="5")", x, y);
  }

  bool has_room(const Box& label) {
    if (label.left < plot.left || label.right > plot.right + 12 || label.top < plot.top) return false;
    for (const Box& other : taken_)
      if (label.left < other.right && other.left < label.right && label.top < other.bottom &&
          other.top < label.bottom)
        return false;
    taken_.push_back(label);
    return true;
  }

  // Above the mark on either side, else below it, else nowhere: a label in another's way tells nothing.
  void draw_label(const ChartPoint& p) {
    const double x = p.failed ? failed_at : x_.at(p.x), y = y_.at(p.y);
    const double length = letter_width * static_cast<double>(p.label.size());
    for (const double base : {y - 7, y + 7 + label_height})
      for (const double left : {x + 6, x - 6 - length}) {
        if (!has_room({left, base - label_height, left + length, base})) continue;
        text(left, base, p.label, R"( class="label" font-size="11" fill="#444")");
        return;
      }
  }

  void draw_labels() {
    for (const ChartSeries& series : chart_.series)
      for (const auto& ladder : series.ladders)
        for (const ChartPoint& p : ladder)
          if (drawable(p) && !p.label.empty()) draw_label(p);
  }

  void draw_legend() {
    double y = plot.top + 15;
    for (std::size_t s = 0, shown = 0; s < chart_.series.size() && shown < 24; ++s) {
      if (!has_mark(chart_.series[s])) continue;
      ++shown;
      if (chart_.curves) put(R"(<path d="M{} {}h42" {}/>)", plot.right + 20, y - 5, stroke(s));
      if (!chart_.curves)
        put(R"(<{} fill="{}"/>)", mark_at(chart_.series[s].squares, plot.right + 26, y - 5), chart_colour(s));
      text(plot.right + (chart_.curves ? 68 : 40), y, chart_.series[s].name);
      y += 22;
    }
    for (const std::string& key : chart_.keys) text(plot.right + 20, y, key, R"( fill="#666")"), y += 22;
    if (!chart_.labels.empty())
      text(plot.right + 20, y, "at marks: " + chart_.labels, R"( fill="#666")"), y += 22;
    if (has_failed(chart_)) text(plot.right + 20, y, "hollow: failed, no error to tell", R"( fill="#666")");
  }

  const Chart& chart_;
  std::vector<ChartPoint> good_; ///< with a place in x and in y
  Axis x_, y_;
  std::vector<Box> taken_; ///< by labels
};

} // namespace

std::vector<ChartPoint> pareto_front(const std::vector<ChartPoint>& points) {
  std::vector<ChartPoint> sorted = points, front;
  std::stable_sort(sorted.begin(), sorted.end(), [](const ChartPoint& a, const ChartPoint& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  for (const ChartPoint& p : sorted)
    if (front.empty() || p.y < front.back().y) front.push_back(p);
  return front;
}

std::string svg_of(const Chart& chart) {
  return ChartDrawing(chart).finish();
}

} // namespace hopmesh::pictures
