// Bars of parts: heights by hand, signs, and places that have nothing to show.
#include "sim/pictures/svg_bars.h"

#include <gtest/gtest.h>
#include <regex>

namespace hopmesh::tests {
namespace {

using pictures::StackedBars;

/// Heights of the bars, in the order in which they are drawn.
std::vector<double> heights(const std::string& svg) {
  static const std::regex bar("class=\"bar\"[^>]* height=\"([0-9.]+)\"");
  std::vector<double> all;
  for (std::sregex_iterator at(svg.begin(), svg.end(), bar), end; at != end; ++at)
    all.push_back(std::stod((*at)[1]));
  return all;
}

// Two places: 3 up; 2 up and 1 down. Drawn in one unit, so heights are 3 : 0 : 2 : 1.
TEST(SvgBars, AreAsHighAsTheirParts) {
  StackedBars bars;
  bars.x = {1, 2};
  bars.parts = {{"one", {3, 2}, {3, 2}}, {"other <", {0, -1}, {0, 1}}};
  bars.floor = {0.1, 0.1};
  bars.floor_name = "floor";
  const std::string svg = svg_of(bars);
  const std::vector<double> found = heights(svg);
  ASSERT_EQ(found.size(), 4u);
  const double unit = found[3];
  EXPECT_GT(unit, 10);
  EXPECT_NEAR(found[0] / unit, 3, 0.01);
  EXPECT_EQ(found[1], 0);
  EXPECT_NEAR(found[2] / unit, 2, 0.01);
  EXPECT_NE(svg.find("other &lt;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(SvgBars, OfNothingAtAllAreAFrame) {
  StackedBars bars;
  bars.x = {1};
  bars.parts = {{"one", {0}, {0}}};
  const std::string svg = svg_of(bars);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

} // namespace
} // namespace hopmesh::tests
