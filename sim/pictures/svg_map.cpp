#include "sim/pictures/svg_map.h"

#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hopmesh::pictures {

namespace {

constexpr double side = 380, pitch_x = 426, pitch_y = 464, left = 86, top = 104; // of the panels
constexpr const char* dashes[] = {"none", "7 4", "2 4"};                         // of a panel's lines

/// Of panels: a few stand in one row.
std::size_t columns_for(std::size_t panels) {
  return panels <= 3 ? std::max<std::size_t>(1, panels) : std::size_t(std::ceil(std::sqrt(double(panels))));
}

double right_of(const CellMap& map) {
  return left + double(columns_for(map.panels.size())) * pitch_x;
}

double bottom_of(const CellMap& map) {
  const std::size_t columns = columns_for(map.panels.size());
  const std::size_t rows = (map.panels.size() + columns - 1) / columns;
  return top + double(rows) * pitch_y;
}

class MapDrawing : public SvgCanvas {
 public:
  explicit MapDrawing(const CellMap& map)
      : SvgCanvas(std::max(640.0, right_of(map)), bottom_of(map) + 88, left, map.title), map_(map),
        cell_x_(side / double(map.xs.size())), cell_y_(side / double(map.ys.size())) {
    const std::size_t columns = columns_for(map.panels.size());
    for (std::size_t p = 0; p < map.panels.size(); ++p) {
      const std::size_t row = p / columns, column = p % columns;
      const double x = left + double(column) * pitch_x, y = top + double(row) * pitch_y;
      draw_panel(map.panels[p], {x, y, x + side, y + side}, column == 0);
    }
    name_lines(name_kinds(bottom_of(map) + 8) + 24);
  }

 private:
  void draw_panel(const MapPanel& panel, const Box& box, bool leftmost) {
    for (std::size_t y = 0; y < panel.cells.size(); ++y)
      for (std::size_t x = 0; x < panel.cells[y].size(); ++x)
        draw_cell(panel.cells[y][x], box.left + double(x) * cell_x_, box.bottom - double(y + 1) * cell_y_);
    put(R"(<svg x="{}" y="{}" width="{}" height="{}">)", box.left, box.top, side, side); // cuts lines off
    for (std::size_t k = 0; k < panel.lines.size(); ++k) draw_line(panel.lines[k], dashes[k % 3]);
    put("</svg>");
    frame(box, panel.title, map_.x_label, leftmost ? map_.y_label : "");
    draw_numbers(box, leftmost);
  }

  void draw_cell(const MapCell& cell, double x, double y) {
    put(R"(<rect class="cell" x="{}" y="{}" width="{}" height="{}" fill="{}" stroke="#fff" data-command="{}">)"
        "<title>{}</title></rect>",
        x, y, cell_x_, cell_y_, map_.kinds[cell.kind].colour, escaped(cell.command),
        escaped(cell.tip + '\n' + cell.command));
  }

  // Dark on a light halo: seen on any colour.
  void draw_line(const MapLine& line, const char* dashed) {
    Points points;
    for (const auto& [x, y] : line.points)
      points.emplace_back(place_among(map_.xs, x) * cell_x_, side - place_among(map_.ys, y) * cell_y_);
    const std::string path = path_through(points);
    put(R"(<path d="{}" fill="none" stroke="#fff" stroke-width="4.5"/>)", path);
    put(R"(<path d="{}" fill="none" stroke="#111" stroke-width="1.8" stroke-dasharray="{}"><title>{}</title></path>)",
        path, dashed, escaped(line.name));
  }

  // No more than can be read.
  void draw_numbers(const Box& box, bool leftmost) {
    for (std::size_t k = 0; k < map_.xs.size(); k += 1 + map_.xs.size() / 9)
      number_x(box, box.left + (double(k) + 0.5) * cell_x_, fmt::format("{:.3g}", map_.xs[k]));
    for (std::size_t k = 0; leftmost && k < map_.ys.size(); k += 1 + map_.ys.size() / 16)
      number_y(box, box.bottom - (double(k) + 0.5) * cell_y_, fmt::format("{:.3g}", map_.ys[k]));
  }

  /// Returns where its last row stands.
  double name_kinds(double y) {
    double x = left;
    for (const KindOfCell& kind : map_.kinds) {
      if (x > right_of(map_) - 140) x = left, y += 22;
      x = name(x, y, kind.colour, kind.name);
    }
    return y;
  }

  // A legend must not speak of a line that nobody sees.
  void name_lines(double y) {
    double x = left;
    std::set<std::string> told;
    for (const MapPanel& panel : map_.panels)
      for (std::size_t k = 0; k < panel.lines.size(); ++k) {
        std::string words = panel.lines[k].name;
        if (panel.lines[k].points.empty() || !told.insert(words).second) continue;
        if (!is_seen(words)) words += " (beyond the map)";
        put(R"(<path d="M{} {}h26" stroke="#111" stroke-width="1.8" stroke-dasharray="{}"/>)", x, y - 5,
            dashes[k % 3]);
        text(x + 33, y, words);
        x += 60 + 7.2 * static_cast<double>(words.size());
      }
  }

  bool is_seen(const std::string& line_name) const {
    const auto inside = [](const std::vector<double>& values, double value) {
      const double place = place_among(values, value);
      return place >= 0 && place <= static_cast<double>(values.size());
    };
    for (const MapPanel& panel : map_.panels)
      for (const MapLine& line : panel.lines)
        for (const auto& [x, y] : line.points)
          if (line.name == line_name && inside(map_.xs, x) && inside(map_.ys, y)) return true;
    return false;
  }

  const CellMap& map_;
  const double cell_x_, cell_y_;
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
  return MapDrawing(map).finish();
}

} // namespace hopmesh::pictures
