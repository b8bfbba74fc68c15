#include "sim/pictures/svg_map.h"

#include "sim/pictures/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace hopmesh::pictures {

namespace {

constexpr double side = 380, gap = 46, left = 86, top = 104, below = 108;
constexpr const char* strokes[] = {"none", "7 4", "2 4"}; // dashes of the first, second and third line

class Drawing {
 public:
  explicit Drawing(const CellMap& map) : map_(map) {
    const auto panels = static_cast<double>(std::max<std::size_t>(1, map.panels.size()));
    columns_ = static_cast<std::size_t>(panels <= 3 ? panels : std::ceil(std::sqrt(panels)));
    cell_x_ = side / static_cast<double>(std::max<std::size_t>(1, map.xs.size()));
    cell_y_ = side / static_cast<double>(std::max<std::size_t>(1, map.ys.size()));
  }

  std::string text() {
    const std::size_t rows = (map_.panels.size() + columns_ - 1) / columns_;
    const double width = std::max(640.0, left + double(columns_) * (side + gap));
    const double height = top + double(rows) * (side + 84) + below - 20;
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"12\" fill=\"#222\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n<text x=\"{2}\" y=\"38\" font-size=\"20\" "
        "font-weight=\"600\">{3}</text>\n",
        width, height, left, xml(map_.title));
    for (std::size_t p = 0; p < map_.panels.size(); ++p) {
      const std::size_t row = p / columns_, column = p % columns_;
      panel(p, left + double(column) * (side + gap), top + double(row) * (side + 84));
    }
    legend(height - below + 16);
    return out_ + "</svg>\n";
  }

 private:
  template <typename... Args> void put(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
  }

  void panel(std::size_t index, double x0, double y0) {
    const MapPanel& panel = map_.panels[index];
    put("<text x=\"{}\" y=\"{}\" font-size=\"15\" font-weight=\"600\">{}</text>\n", x0, y0 - 12,
        xml(panel.title));
    put("<clipPath id=\"panel{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", index,
        x0, y0, side, side);
    for (std::size_t y = 0; y < panel.cells.size(); ++y)
      for (std::size_t x = 0; x < panel.cells[y].size(); ++x)
        cell(panel.cells[y][x], x0 + double(x) * cell_x_, y0 + side - double(y + 1) * cell_y_);
    for (std::size_t k = 0; k < panel.lines.size(); ++k) line(panel.lines[k], k, index, x0, y0);
    ticks(x0, y0, index % columns_ == 0);
  }

  void cell(const MapCell& c, double x, double y) {
    put("<rect class=\"cell\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "stroke=\"#fff\" "
        "data-command=\"{}\"><title>{}</title></rect>\n",
        x, y, cell_x_, cell_y_, map_.kinds[c.kind].colour, xml(c.command), xml(c.tip + '\n' + c.command));
  }

  void line(const MapLine& l, std::size_t k, std::size_t index, double x0, double y0) {
    std::string path;
    for (const auto& [x, y] : l.points)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x0 + place_among(map_.xs, x) * cell_x_,
                          y0 + side - place_among(map_.ys, y) * cell_y_);
    if (path.empty()) return;
    for (const bool halo : {true, false})
      put("<path clip-path=\"url(#panel{})\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
          "stroke-dasharray=\"{}\"><title>{}</title></path>\n",
          index, path, halo ? "#fff" : "#111", halo ? 4.5 : 1.8, halo ? "none" : strokes[k % 3], xml(l.name));
  }

  // So many numbers as can be read.
  void ticks(double x0, double y0, bool outermost) {
    const std::size_t every_x = 1 + map_.xs.size() / 9, every_y = 1 + map_.ys.size() / 16;
    for (std::size_t k = 0; k < map_.xs.size(); k += every_x)
      put("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.3g}</text>\n",
          x0 + (double(k) + 0.5) * cell_x_, y0 + side + 17, map_.xs[k]);
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"13\">{}</text>\n", x0 + side / 2,
        y0 + side + 38, xml(map_.x_label));
    if (!outermost) return;
    for (std::size_t k = 0; k < map_.ys.size(); k += every_y)
      put("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g}</text>\n", x0 - 7,
          y0 + side - (double(k) + 0.5) * cell_y_ + 4, map_.ys[k]);
    put("<text transform=\"translate(24 {:.1f}) rotate(-90)\" text-anchor=\"middle\" "
        "font-size=\"13\">{}</text>\n",
        y0 + side / 2, xml(map_.y_label));
  }

  void legend(double y) {
    double x = left;
    for (const KindOfCell& kind : map_.kinds) {
      if (x > left + double(columns_) * (side + gap) - 140) x = left, y += 22;
      put("<rect x=\"{0}\" y=\"{1}\" width=\"14\" height=\"14\" fill=\"{2}\"/><text x=\"{3}\" "
          "y=\"{4}\">{5}</text>\n",
          x, y, kind.colour, x + 20, y + 11.5, xml(kind.name));
      x += 44 + 7.0 * static_cast<double>(kind.name.size());
    }
    lines_legend(y + 24);
  }

  bool is_inside(const MapLine& line) const {
    const auto inside = [](const std::vector<double>& values, double value) {
      const double place = place_among(values, value);
      return place >= 0 && place <= static_cast<double>(values.size());
    };
    return std::any_of(line.points.begin(), line.points.end(), [&](const auto& point) {
      return inside(map_.xs, point.first) && inside(map_.ys, point.second);
    });
  }

  /// Somewhere in the map; a legend must not speak of a line that nobody sees.
  bool is_seen(const std::string& name) const {
    for (const MapPanel& panel : map_.panels)
      for (const MapLine& line : panel.lines)
        if (line.name == name && is_inside(line)) return true;
    return false;
  }

  void lines_legend(double y) {
    double x = left;
    std::set<std::string> told;
    for (const MapPanel& panel : map_.panels)
      for (std::size_t k = 0; k < panel.lines.size(); ++k) {
        if (panel.lines[k].points.empty() || !told.insert(panel.lines[k].name).second) continue;
        const bool seen = is_seen(panel.lines[k].name);
        const std::string name = panel.lines[k].name + (seen ? "" : " (beyond the map)");
        put("<path d=\"M{} {}h26\" stroke=\"#111\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"/><text "
            "x=\"{}\" "
            "y=\"{}\">{}</text>\n",
            x, y + 7, strokes[k % 3], x + 33, y + 11.5, xml(name));
        x += 60 + 7.0 * static_cast<double>(name.size());
      }
  }

  const CellMap& map_;
  std::size_t columns_ = 1;
  double cell_x_ = 1, cell_y_ = 1;
  std::string out_;
};

} // namespace

double place_among(const std::vector<double>& values, double value) {
  if (values.size() < 2) return 0.5;
  const bool logarithmic = values.front() > 0 && value > 0;
  const auto measure = [logarithmic](double v) { return logarithmic ? std::log(v) : v; };
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value);
  const double a = measure(*(above - 1)), b = measure(*above);
  return static_cast<double>(above - values.begin()) - 0.5 + (measure(value) - a) / (b - a);
}

std::string svg_of(const CellMap& map) {
  return Drawing(map).text();
}

} // namespace hopmesh::pictures
