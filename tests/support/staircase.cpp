// SVG by hand: a white card, two axes, the line y = x in grey, the characteristic in blue.
#include "tests/support/staircase.h"

#include <cmath>
#include <sstream>

namespace hopmesh::tests {
namespace {

constexpr double size = 200, margin = 16;

/// Coordinates of a picture whose x reaches from -x_reach to x_reach, y likewise.
struct Sheet {
  double x_reach, y_reach;
  std::ostringstream svg;

  double px(double x) const { return size / 2 + x / x_reach * (size / 2 - margin); }
  double py(double y) const { return size / 2 - y / y_reach * (size / 2 - margin); }
  void line(double x0, double y0, double x1, double y1, const char* style) {
    svg << "<line x1=\"" << px(x0) << "\" y1=\"" << py(y0) << "\" x2=\"" << px(x1) << "\" y2=\"" << py(y1)
        << "\" " << style << "/>\n";
  }
  void dot(double x, double y, double radius, const char* style) {
    svg << "<circle cx=\"" << px(x) << "\" cy=\"" << py(y) << "\" r=\"" << radius << "\" " << style << "/>\n";
  }
  void open(const std::string& title) {
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << size << "\" height=\"" << size
        << "\" role=\"img\">\n"
        << "<title>" << title << "</title>\n"
        << "<rect width=\"" << size << "\" height=\"" << size << "\" rx=\"6\" fill=\"#ffffff\"/>\n";
    line(-x_reach, 0, x_reach, 0, "stroke=\"#999999\"");
    line(0, -y_reach, 0, y_reach, "stroke=\"#999999\"");
    const double end = std::fmin(x_reach, y_reach);
    line(-end, -end, end, end, "stroke=\"#cccccc\" stroke-dasharray=\"3 3\"");
  }
  void ticks(double step) {
    for (double x = step; x <= x_reach; x += step)
      for (double at : {x, -x}) line(at, -0.02 * y_reach, at, 0.02 * y_reach, "stroke=\"#999999\"");
    for (double y = step; y <= y_reach; y += step)
      for (double at : {y, -y}) line(-0.02 * x_reach, at, 0.02 * x_reach, at, "stroke=\"#999999\"");
  }
  std::string close(const std::string& title) {
    svg << "<text x=\"8\" y=\"18\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333333\">" << title
        << "</text>\n</svg>\n";
    return svg.str();
  }
};

constexpr const char* step_style = "stroke=\"#1f5fa8\" stroke-width=\"2\"";
constexpr const char* full = "fill=\"#1f5fa8\"";
constexpr const char* hollow = "fill=\"#ffffff\" stroke=\"#1f5fa8\"";

} // namespace

std::string draw_staircase(const std::string& title, int reach,
                           const std::function<std::int64_t(int)>& code) {
  Sheet sheet{static_cast<double>(reach), static_cast<double>(reach), {}};
  sheet.open(title);
  sheet.ticks(1);
  for (int half = -2 * reach; half < 2 * reach; ++half) { // code is constant between two halves
    const double y = static_cast<double>(code(2 * half + 1));
    sheet.line(half / 2.0, y, half / 2.0 + 0.5, y, step_style);
  }
  for (int half = 1 - 2 * reach; half < 2 * reach; ++half) {
    const std::int64_t left = code(2 * half - 1), right = code(2 * half + 1), here = code(2 * half);
    if (left == right) continue;
    sheet.dot(half / 2.0, static_cast<double>(here == left ? right : left), 3, hollow);
    sheet.dot(half / 2.0, static_cast<double>(here), 3, full);
  }
  return sheet.close(title);
}

std::string draw_dots(const std::string& title, int reach, int height,
                      const std::function<std::int64_t(int)>& code) {
  Sheet sheet{static_cast<double>(reach), static_cast<double>(height), {}};
  sheet.open(title);
  sheet.ticks(4);
  for (int x = -reach; x <= reach; ++x) sheet.dot(x, static_cast<double>(code(x)), 2.2, full);
  return sheet.close(title);
}

} // namespace hopmesh::tests
