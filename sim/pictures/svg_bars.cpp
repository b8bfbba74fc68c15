#include "sim/pictures/svg_bars.h"

#include "sim/pictures/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::pictures {

namespace {

constexpr double width = 1180, height = 520, top = 104, bottom = 420, panel = 470, left = 84, gap = 96;

/// 1, 2 or 5 times a power of ten: about five of them in `span`.
double step_for(double span) {
  const double power = std::pow(10, std::floor(std::log10(span / 5)));
  for (double digit : {1.0, 2.0, 5.0})
    if (digit * power >= span / 5) return digit * power;
  return 10 * power;
}

class Drawing {
 public:
  explicit Drawing(const StackedBars& bars) : bars_(bars) {
    find_span();
    find_decades();
  }

  std::string text() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"#222\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n<text x=\"{2}\" y=\"34\" font-size=\"20\" "
        "font-weight=\"600\">{3}</text>\n<text x=\"{2}\" y=\"56\" fill=\"#666\">{4}</text>\n",
        width, height, left, xml(bars_.title), xml(bars_.note));
    put("<text transform=\"translate(22 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (top + bottom) / 2, xml(bars_.y_label));
    stacked();
    lengths();
    legend();
    return out_ + "</svg>\n";
  }

 private:
  template <typename... Args> void put(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
  }

  /// Heights of the bars above zero, depths below.
  void find_span() {
    for (std::size_t k = 0; k < bars_.x.size(); ++k) {
      double up = 0, down = 0;
      for (const BarPart& part : bars_.parts) (part.stacked[k] > 0 ? up : down) += part.stacked[k];
      high_ = std::max(high_, up), low_ = std::min(low_, down);
    }
    if (high_ <= low_) high_ = low_ + 1;
    high_ += 0.05 * (high_ - low_);
    if (low_ < 0) low_ -= 0.05 * (high_ - low_);
  }

  void find_decades() {
    std::vector<double> all = bars_.floor;
    for (const BarPart& part : bars_.parts) all.insert(all.end(), part.length.begin(), part.length.end());
    all.erase(std::remove_if(all.begin(), all.end(), [](double v) { return !(v > 0); }), all.end());
    if (all.empty()) return;
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    first_ = std::floor(std::log10(*least)), last_ = std::max(first_ + 1, std::ceil(std::log10(*most)));
  }

  double linear(double value) const { return bottom - (value - low_) / (high_ - low_) * (bottom - top); }
  double logarithmic(double value) const {
    return bottom - (std::log10(value) - first_) / (last_ - first_) * (bottom - top);
  }
  /// The middle of a place's slot in a panel.
  double place(double from, std::size_t k) const {
    return from + panel * (static_cast<double>(k) + 0.5) / static_cast<double>(bars_.x.size());
  }

  void frame(double from, const std::string& title) {
    put("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999\"/>\n", from, top,
        panel, bottom - top);
    put("<text x=\"{}\" y=\"{}\" font-size=\"15\" font-weight=\"600\">{}</text>\n", from, top - 14,
        xml(title));
    for (std::size_t k = 0; k < bars_.x.size(); ++k)
      put("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:.3g}</text>\n", place(from, k), bottom + 20,
          bars_.x[k]);
    put("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", from + panel / 2, bottom + 42,
        xml(bars_.x_label));
  }

  void line_at(double from, double y, const std::string& number) {
    put("<path d=\"M{} {:.1f}h{}\" stroke=\"#e2e2e2\"/><text x=\"{}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{}</text>\n",
        from, y, panel, from - 8, y + 4.5, number);
  }

  void stacked() {
    const double step = step_for(high_ - low_);
    for (int k = static_cast<int>(std::ceil(low_ / step)); k * step <= high_; ++k)
      line_at(left, linear(k * step), fmt::format("{:.3g}", k * step));
    const double wide = 0.62 * panel / static_cast<double>(std::max<std::size_t>(1, bars_.x.size()));
    for (std::size_t k = 0; k < bars_.x.size(); ++k) bar(k, place(left, k) - wide / 2, wide);
    put("<path d=\"M{} {:.1f}h{}\" stroke=\"#222\"/>\n", left, linear(0), panel);
    frame(left, bars_.stacked_title);
  }

  void bar(std::size_t k, double x, double wide) {
    double up = 0, down = 0;
    for (std::size_t p = 0; p < bars_.parts.size(); ++p) {
      const double value = bars_.parts[p].stacked[k];
      double& end = value > 0 ? up : down;
      const double from = linear(std::max(end, end + value)), to = linear(std::min(end, end + value));
      end += value;
      put("<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.2f}\" width=\"{:.1f}\" height=\"{:.2f}\" "
          "fill=\"{}\"><title>{}: {:.3g}</title></rect>\n",
          x, from, wide, to - from, chart_colour(p), xml(bars_.parts[p].name), value);
    }
  }

  void lengths() {
    const double from = left + panel + gap;
    for (double decade = first_; decade <= last_; ++decade)
      line_at(from, logarithmic(std::pow(10, decade)),
              fmt::format("10<tspan dy=\"-5\" font-size=\"10\">{:g}</tspan>", decade));
    for (std::size_t p = 0; p < bars_.parts.size(); ++p)
      curve(from, bars_.parts[p].length, chart_colour(p), bars_.parts[p].name, "");
    curve(from, bars_.floor, "#b03a2e", bars_.floor_name, "8 4");
    frame(from, bars_.length_title);
  }

  void curve(double from, const std::vector<double>& values, const char* colour, const std::string& name,
             const char* dashes) {
    std::string path, dots;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!(values[k] > 0)) continue;
      const double x = place(from, k), y = logarithmic(values[k]);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"><title>{}: "
                          "{:.3g}</title></circle>\n",
                          x, y, colour, xml(name), values[k]);
    }
    put("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"{}\"/>\n{}", path,
        colour, dashes, *dashes ? "" : dots);
  }

  void legend() {
    double x = left;
    const double y = height - 26;
    const auto entry = [&](const std::string& name, const char* colour) {
      put("<rect x=\"{:.1f}\" y=\"{}\" width=\"13\" height=\"13\" fill=\"{}\"/><text x=\"{:.1f}\" "
          "y=\"{}\">{}</text>\n",
          x, y - 11, colour, x + 19, y, xml(name));
      x += 52 + 7.2 * static_cast<double>(name.size());
    };
    for (std::size_t p = 0; p < bars_.parts.size(); ++p) entry(bars_.parts[p].name, chart_colour(p));
    entry(bars_.floor_name, "#b03a2e");
  }

  const StackedBars& bars_;
  double low_ = 0, high_ = 0, first_ = -1, last_ = 0;
  std::string out_;
};

} // namespace

std::string svg_of(const StackedBars& bars) {
  return Drawing(bars).text();
}

} // namespace hopmesh::pictures
