// What all charts are made of, as SVG: paper, words, axes, frames with their numbers, legends.
#pragma once

#include <fmt/format.h>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hopmesh::pictures {

/// For text and attributes of XML and HTML.
std::string escaped(const std::string& text);

/// Colours that stay apart for the colour-blind; they repeat after the sixteenth.
const char* chart_colour(std::size_t series);

/// A rectangle on the paper, in pixels from the left and from the top.
struct Box {
  double left, top, right, bottom;
};

/// From values to pixels. Low and high are values; of a logarithmic axis they are exponents of ten.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  bool logarithmic = false;

  double at(double value) const;
};

using Points = std::vector<std::pair<double, double>>; ///< in pixels
std::string path_through(const Points& points);        ///< "M1.0 2.0L3.0 4.0", as a <path> has it
std::string power_of_ten(int exponent, int digit = 1); ///< markup for digit * 10^exponent

class SvgCanvas {
  template <typename T> using Shown = std::conditional_t<std::is_same_v<T, double>, std::string, T>;

 public:
  SvgCanvas(double width, double height, double left, const std::string& title, const std::string& note = "");

  /// Any element. Doubles are pixels, and shown to a tenth.
  template <typename... Args> void put(fmt::format_string<Shown<Args>...> element, const Args&... args) {
    svg_ += fmt::format(element, shown(args)...) + '\n';
  }
  /// Words are escaped; `more` is further attributes.
  void text(double x, double y, const std::string& words, const char* more = "");
  void upright(double x, double y, const std::string& words, const char* more);
  void frame(const Box& box, const std::string& heading, const std::string& x_label,
             const std::string& y_label);
  /// A number (markup) below the frame or left of it, and a line across the frame where a colour is given.
  void number_x(const Box& box, double x, const std::string& number, const char* line_colour = nullptr);
  void number_y(const Box& box, double y, const std::string& number, const char* line_colour = nullptr);
  /// A colour and its name in a legend; returns the x of the next.
  double name(double x, double y, const std::string& colour, const std::string& words);
  std::string finish() { return svg_ + "</svg>\n"; }

 private:
  static std::string shown(double pixels);
  template <typename T> static const T& shown(const T& other) { return other; }

  std::string svg_;
};

} // namespace hopmesh::pictures
