#include "sim/pictures/svg_canvas.h"

#include <cmath>
#include <iterator>

namespace hopmesh::pictures {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
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

double Axis::at(double value) const {
  return from + ((logarithmic ? std::log10(value) : value) - low) / (high - low) * (to - from);
}

std::string path_through(const Points& points) {
  std::string path;
  for (const auto& [x, y] : points) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
  return path;
}

std::string power_of_ten(int exponent, int digit) {
  const std::string times = digit == 1 ? "" : fmt::format("{}·", digit);
  return times + fmt::format(R"(10<tspan dy="-5" font-size="10">{}</tspan>)", exponent);
}

SvgCanvas::SvgCanvas(double width, double height, double left, const std::string& title,
                     const std::string& note) {
  put(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" fill="#222" )"
      R"(font-family="system-ui, 'DejaVu Sans', sans-serif" font-size="13">)",
      width, height);
  put(R"(<rect width="{}" height="{}" fill="#fff"/>)", width, height);
  text(left, 34, title, R"( font-size="20" font-weight="600")");
  text(left, 56, note, R"( fill="#666")");
}

std::string SvgCanvas::shown(double pixels) {
  std::string text = fmt::format("{:.1f}", pixels);
  if (text.back() == '0') text.resize(text.size() - 2);
  return text;
}

// No words: no element.
void SvgCanvas::text(double x, double y, const std::string& words, const char* more) {
  if (!words.empty()) put(R"(<text x="{}" y="{}"{}>{}</text>)", x, y, more, escaped(words));
}

void SvgCanvas::upright(double x, double y, const std::string& words, const char* more) {
  if (!words.empty())
    put(R"svg(<text transform="translate({} {}) rotate(-90)"{}>{}</text>)svg", x, y, more, escaped(words));
}

void SvgCanvas::frame(const Box& box, const std::string& heading, const std::string& x_label,
                      const std::string& y_label) {
  put(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#999"/>)", box.left, box.top,
      box.right - box.left, box.bottom - box.top);
  text(box.left, box.top - 14, heading, R"( font-size="15" font-weight="600")");
  text((box.left + box.right) / 2, box.bottom + 42, x_label, R"( text-anchor="middle")");
  upright(box.left - 62, (box.top + box.bottom) / 2, y_label, R"( text-anchor="middle")");
}

void SvgCanvas::number_x(const Box& box, double x, const std::string& number, const char* line_colour) {
  if (line_colour) put(R"(<path d="M{} {}V{}" stroke="{}"/>)", x, box.top, box.bottom, line_colour);
  if (!number.empty())
    put(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", x, box.bottom + 20, number);
}

void SvgCanvas::number_y(const Box& box, double y, const std::string& number, const char* line_colour) {
  if (line_colour) put(R"(<path d="M{} {}H{}" stroke="{}"/>)", box.left, y, box.right, line_colour);
  if (!number.empty())
    put(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", box.left - 8, y + 4.5, number);
}

double SvgCanvas::name(double x, double y, const std::string& colour, const std::string& words) {
  put(R"(<rect x="{}" y="{}" width="13" height="13" fill="{}"/>)", x, y - 11, colour);
  text(x + 19, y, words);
  return x + 52 + 7.2 * static_cast<double>(words.size());
}

} // namespace hopmesh::pictures
