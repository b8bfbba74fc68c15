#include "tests/bench/tables/network_pictures.h"

#include "sim/files/png.h"
#include "sim/networks/problems/making.h"
#include "sim/pictures/svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace hopmesh::bench {
namespace {

// ---- recall

constexpr std::size_t rows = 25, columns = 40, side = 7, gap = 14;

void draw_panel(files::Picture& picture, std::size_t panel, const std::vector<double>& V) {
  const std::size_t left = panel * (columns * side + gap);
  for (std::size_t y = 0; y < rows * side; ++y)
    for (std::size_t x = 0; x < columns * side; ++x) {
      const bool on = V[y / side * columns + x / side] > 0;
      std::uint8_t* pixel = &picture.rgba[4 * (y * picture.width + left + x)];
      pixel[0] = on ? 24 : 238, pixel[1] = on ? 62 : 226, pixel[2] = on ? 112 : 196;
    }
}

std::vector<double> values_of(const std::string& market) {
  std::istringstream lines(market);
  std::string line;
  std::vector<double> values;
  std::getline(lines, line), std::getline(lines, line);
  while (std::getline(lines, line)) values.push_back(std::stod(line));
  return values;
}

// ---- diagonal

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

constexpr double left = 70, top = 40, width = 560, height = 300, least_x = -8, most_x = 1, decades = 4;
constexpr std::size_t instances = 9;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::pair<double, double> place(const std::pair<double, double>& point) {
  const double x = (point.first - least_x) / (most_x - least_x);
  const double y = std::log10(std::max(1.0, point.second)) / decades;
  return {left + width * x, top + height * (1 - y)};
}

std::string axes() {
  std::string svg;
  for (int decade = 0; decade <= static_cast<int>(decades); ++decade) {
    const double y = place({least_x, std::pow(10, decade)}).second;
    svg += fmt::format("<line x1='{0}' y1='{2:.1f}' x2='{1}' y2='{2:.1f}' class='g'/>"
                       "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:.0f}</text>\n",
                       left, left + width, y, left - 8, y + 4, std::pow(10, decade));
  }
  for (double d = least_x; d <= most_x; d += 1) {
    const double x = place({d, 1}).first;
    svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' class='g'/>"
                       "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4:g}</text>\n",
                       x, top, top + height, top + height + 20, d);
  }
  return svg;
}

std::string drawn(const Curve& curve, std::size_t number) {
  const char* colour = pictures::chart_colour(number);
  std::string line, dots;
  for (const auto& point : curve.points) {
    const auto [x, y] = place(point);
    line += fmt::format("{:.1f},{:.1f} ", x, y);
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}'/>", x, y, colour);
  }
  const double y = top + 18 + 18 * static_cast<double>(number);
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='2'/>{}\n"
                     "<rect x='{}' y='{}' width='14' height='4' fill='{}'/><text x='{}' y='{}'>{}</text>\n",
                     line, colour, dots, left + 16, y - 6, colour, left + 36, y,
                     pictures::escaped(curve.name));
}

std::string svg_of(const std::vector<Curve>& curves) {
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' font-family='sans-serif' font-size='13'>\n"
      "<style>.g{{stroke:#ddd}}</style><rect width='100%' height='100%' fill='white'/>\n"
      "<text x='{}' y='24' font-size='15'>Sweeps to rest against the diagonal; 1,000 neurons, median of "
      "{}</text>\n",
      left + width + 30, top + height + 60, left, instances);
  svg += axes();
  for (std::size_t k = 0; k < curves.size(); ++k) svg += drawn(curves[k], k);
  return svg + fmt::format("<text x='{}' y='{}' text-anchor='middle'>d, where W_ii = d Σ|W_ij| of the "
                           "row</text>\n</svg>\n",
                           left + width / 2, top + height + 46);
}

} // namespace

std::string recall_picture(const ProblemRuns& runs) {
  problems::Problem p = problems::make("memory-1000");
  const std::vector<double> stored = problems::pattern_of("memory-1000", 1);
  problems::Dice dice(5);
  for (std::size_t i = 0; i < stored.size(); ++i) p.start[i] = dice.unit() < 0.2 ? -stored[i] : stored[i];
  const Solved s = runs.solve(runs.written(p), "engine", "--rule binary");
  files::Picture picture{static_cast<std::uint32_t>(3 * columns * side + 2 * gap), rows * side, {}};
  picture.rgba.assign(4 * std::size_t{picture.width} * picture.height, 255);
  draw_panel(picture, 0, stored);
  draw_panel(picture, 1, p.start);
  draw_panel(picture, 2, values_of(s.V));
  return files::encode_png(picture);
}

std::string diagonal_chart(const ProblemRuns& runs) {
  std::vector<Curve> curves{{"engine, 16-bit links", {}}, {"reference, double", {}}};
  fmt::print("| d | sweeps, engine | reference |\n|---|---|---|\n");
  for (const double d : {-8.0, -6.0, -4.0, -3.0, -2.0, -1.5, -1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 1.0}) {
    std::vector<double> engine, reference;
    for (std::size_t k = 0; k < instances; ++k) {
      const std::string what = runs.written(problems::random_quadratic(1000 + k, 8, -d - 1));
      engine.push_back(static_cast<double>(runs.solve(what, "engine").sweeps));
      reference.push_back(static_cast<double>(runs.solve(what, "reference").sweeps));
    }
    curves[0].points.emplace_back(d, median(engine));
    curves[1].points.emplace_back(d, median(reference));
    fmt::print("| {} | {} | {} |\n", d, curves[0].points.back().second, curves[1].points.back().second);
  }
  return svg_of(curves);
}

} // namespace hopmesh::bench
