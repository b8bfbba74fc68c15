#include "sim/pictures/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace hopmesh::pictures {

namespace {

constexpr double width = 1100, height = 660, left = 92, right = 800, top = 74, bottom = 560;

/// Decades on paper.
struct LogAxis {
  double low = 0, high = 1, from = 0, to = 1;

  double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
};

/// Room of a fifth of a decade at both ends, and a decade in all at least.
LogAxis axis_over(const std::vector<double>& values, double from, double to) {
  LogAxis axis{0, 1, from, to};
  if (values.empty()) return axis;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  axis.low = std::log10(*least) - 0.2, axis.high = std::log10(*most) + 0.2;
  if (axis.high - axis.low < 1) {
    const double middle = (axis.low + axis.high) / 2;
    axis.low = middle - 0.5, axis.high = middle + 0.5;
  }
  return axis;
}

bool drawable(const ChartPoint& p) {
  return p.y > 0 && std::isfinite(p.y) && (p.failed || (p.x > 0 && std::isfinite(p.x)));
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {
    std::vector<double> xs, ys;
    for (const ChartPoint& p : all()) {
      if (!drawable(p)) ++left_out_;
      if (drawable(p) && !p.failed) xs.push_back(p.x);
      if (drawable(p)) ys.push_back(p.y);
    }
    for (const ChartLine& line : chart.lines)
      if (line.x > 0) xs.push_back(line.x);
    x_ = axis_over(xs, left, right - 34); // the last 34 are for what failed
    y_ = axis_over(ys, bottom, top);
  }

  std::string text() {
    frame();
    grid();
    if (chart_.guides && !chart_.curves) guides();
    lines();
    if (!chart_.curves) front();
    const std::size_t count = chart_.series.size();
    for (std::size_t s = 0; s < count; ++s) series(chart_.curves ? count - 1 - s : s); // the first on top
    legend();
    return out_ + "</svg>\n";
  }

 private:
  template <typename... Args> void put(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
  }

  std::vector<ChartPoint> all() const {
    std::vector<ChartPoint> points;
    for (const ChartSeries& s : chart_.series)
      for (const auto& ladder : s.ladders) points.insert(points.end(), ladder.begin(), ladder.end());
    return points;
  }

  void frame() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"#222\">\n",
        width, height);
    put("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
    put("<clipPath id=\"plot\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", left, top,
        right - left, bottom - top);
    put("<text x=\"{}\" y=\"34\" font-size=\"20\" font-weight=\"600\">{}</text>\n", left, xml(chart_.title));
    put("<text x=\"{}\" y=\"56\" fill=\"#666\">lower left is better{}</text>\n", left,
        chart_.curves ? "" : "; dashed: nobody is better in both");
    put("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", (left + right) / 2, bottom + 46,
        xml(chart_.x_label));
    put("<text transform=\"translate(26 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (top + bottom) / 2, xml(chart_.y_label));
    if (left_out_ > 0)
      put("<text x=\"{}\" y=\"{}\" fill=\"#666\" font-size=\"12\">{} points have no place here (a zero or an "
          "empty "
          "cell)</text>\n",
          left, bottom + 72, left_out_);
  }

  // A line a decade, thin ones at 2..9, and numbers where decades are.
  void grid() {
    for (const bool along_x : {true, false}) {
      const LogAxis& axis = along_x ? x_ : y_;
      for (int decade = int(std::floor(axis.low)); decade <= int(std::ceil(axis.high)); ++decade)
        for (int digit = 1; digit <= 9; ++digit) grid_line(axis, along_x, decade, digit);
    }
    put("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999\"/>\n", left, top,
        right - left, bottom - top);
  }

  void grid_line(const LogAxis& axis, bool along_x, int decade, int digit) {
    const double value = digit * std::pow(10, decade), at = axis.at(value);
    if (std::log10(value) < axis.low || std::log10(value) > axis.high) return;
    const char* colour = digit == 1 ? "#d4d4d4" : "#f1f1f1";
    const bool numbered = digit == 1 || (axis.high - axis.low < 2 && (digit == 2 || digit == 5));
    if (along_x) {
      put("<path d=\"M{:.1f} {}V{}\" stroke=\"{}\"/>\n", at, top, bottom, colour);
      if (numbered)
        put("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", at, bottom + 20,
            number(decade, digit));
    } else {
      put("<path d=\"M{} {:.1f}H{}\" stroke=\"{}\"/>\n", left, at, right, colour);
      if (numbered)
        put("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", left - 8, at + 4.5,
            number(decade, digit));
    }
  }

  static std::string number(int decade, int digit) {
    if (decade >= -2 && decade <= 3) return fmt::format("{:g}", digit * std::pow(10, decade));
    return fmt::format("{}10<tspan dy=\"-5\" font-size=\"10\">{}</tspan>",
                       digit == 1 ? "" : fmt::format("{}·", digit), decade);
  }

  // From the middle of the plot: halving the error costs 2^(1/p) times the work at order p.
  void guides() {
    const double x0 = (x_.low + x_.high) / 2, y0 = (y_.low + y_.high) / 2, reach = (x_.high - x_.low) / 2;
    for (int order : {1, 2, 4}) {
      const double rise = reach / order;
      put("<path clip-path=\"url(#plot)\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#c9c9c9\" "
          "stroke-dasharray=\"2 4\"/>\n",
          x_.at(std::pow(10, x0 - reach)), y_.at(std::pow(10, y0 + rise)), x_.at(std::pow(10, x0 + reach)),
          y_.at(std::pow(10, y0 - rise)));
      const double share = std::min(0.92, 0.92 * (y_.high - y0) / rise);
      put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" fill=\"#999\">order {}</text>\n",
          x_.at(std::pow(10, x0 - reach * share)) + 5, y_.at(std::pow(10, y0 + rise * share)) - 3, order);
    }
  }

  void lines() {
    for (const ChartLine& line : chart_.lines) {
      if (!(line.x > 0)) continue;
      const double at = x_.at(line.x);
      put("<path d=\"M{:.1f} {}V{}\" stroke=\"#b03a2e\" stroke-width=\"1.5\" stroke-dasharray=\"8 4\"/>\n",
          at, top, bottom);
      put("<text transform=\"translate({:.1f} {}) rotate(-90)\" font-size=\"11\" "
          "fill=\"#b03a2e\">{}</text>\n",
          at - 5, bottom - 8, xml(line.name)); // at the foot, where there is least work
    }
  }

  void front() {
    std::vector<ChartPoint> good;
    for (const ChartPoint& p : all())
      if (drawable(p) && !p.failed) good.push_back(p);
    std::string path;
    for (const ChartPoint& p : pareto_front(good))
      path += path.empty() ? fmt::format("M{:.1f} {:.1f}", x_.at(p.x), y_.at(p.y))
                           : fmt::format("H{:.1f}V{:.1f}", x_.at(p.x), y_.at(p.y));
    if (!path.empty())
      put("<path class=\"front\" d=\"{}\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.3\" "
          "stroke-dasharray=\"5 "
          "4\" opacity=\"0.75\"/>\n",
          path);
  }

  void series(std::size_t index) {
    const char* colour = chart_colour(index);
    for (const auto& ladder : chart_.series[index].ladders) {
      std::string path;
      for (const ChartPoint& p : ladder)
        if (drawable(p) && !p.failed)
          path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x_.at(p.x), y_.at(p.y));
      put("<path d=\"{}\" fill=\"none\" stroke=\"{}\" {}/>\n", path, colour, stroke(index));
    }
    for (const auto& ladder : chart_.series[index].ladders)
      for (const ChartPoint& p : ladder)
        if (drawable(p) && (!chart_.curves || &p == &ladder.back())) mark(p, colour);
  }

  // Neighbours in the list differ in dashes as well as in colour.
  std::string stroke(std::size_t index) const {
    static constexpr const char* dashes[] = {"none", "8 3", "2 3", "9 3 2 3"};
    if (!chart_.curves) return "stroke-width=\"1.6\" opacity=\"0.55\"";
    return fmt::format("stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-dasharray=\"{}\"",
                       index == 0 ? 4 : 2, dashes[index % std::size(dashes)]);
  }

  void mark(const ChartPoint& p, const char* colour) {
    put("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\" stroke=\"{}\" "
        "stroke-width=\"1.6\" "
        "data-command=\"{}\"><title>{}</title></circle>\n",
        p.failed ? "point failed" : "point", p.failed ? right - 14 : x_.at(p.x), y_.at(p.y),
        p.failed ? "#fff" : colour, p.failed ? colour : "#fff", xml(p.command),
        xml(p.tip + '\n' + p.command));
  }

  void legend() {
    double y = top + 10;
    for (std::size_t s = 0; s < chart_.series.size() && s < 24; ++s, y += 22) {
      if (chart_.curves)
        put("<path d=\"M{} {}h42\" stroke=\"{}\" {}/>", right + 14, y, chart_colour(s), stroke(s));
      put("<circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
          right + (chart_.curves ? 56 : 26), y, chart_colour(s), right + (chart_.curves ? 68 : 40), y + 4.5,
          xml(chart_.series[s].name));
    }
    if (chart_.curves) return;
    put("<circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"#fff\" stroke=\"#666\" stroke-width=\"1.6\"/>"
        "<text x=\"{}\" y=\"{}\" fill=\"#666\">failed: no error to tell</text>\n",
        right + 26, y, right + 40, y + 4.5);
  }

  const Chart& chart_;
  LogAxis x_, y_;
  std::size_t left_out_ = 0;
  std::string out_;
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

std::string xml(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* chart_colour(std::size_t series) {
  static constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                            "#6a4c93", "#7f7f7f", "#8c510a", "#a6a600", "#c51b7d", "#1b4d3e",
                                            "#000000", "#99582a", "#4361ee", "#b8a9ff"};
  return colours[series % std::size(colours)];
}

std::string svg_of(const Chart& chart) {
  return Drawing(chart).text();
}

} // namespace hopmesh::pictures
