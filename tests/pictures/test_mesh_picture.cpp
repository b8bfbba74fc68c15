// picture.svg: what lies where, what hides what, and that no mesh makes a large file.
#include "sim/pictures/mesh_picture.h"

#include "tests/support/files.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <iterator>
#include <regex>

namespace hopmesh::tests {
namespace {

using namespace pictures;

using ::testing::HasSubstr;
using ::testing::Not;

std::string drawn(const RunView& view) {
  const Folder folder;
  write_mesh_picture(view, folder / "picture.svg");
  return content_of(folder / "picture.svg");
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// A pinned node, and one that comes down from 1 beside it to 4 under it.
RunView pendulum() {
  RunView view;
  view.title = "a < b";
  view.nodes = 2;
  view.pinned = {true, false};
  view.springs = {{{0, 1}, 1.0f}};
  view.frames = {{0, 0, 0, 1, 0, 0}, {0, 0, 0, 0, 0, -4}};
  return view;
}

// 1 wide, 4 high: 432 pixels for 4, 24 around.
TEST(MeshPicture, AMeshInAPlaneIsSeenFromStraightAhead) {
  const std::string svg = drawn(pendulum());
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 160 480\""));
  EXPECT_THAT(svg, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M26.00 24.00L134.00 24.00\" fill=\"none\" stroke=\"#b4bfcc\""));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M26.00 24.00L26.00 456.00\" stroke=\"#1f5fa8\""));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"26.00\" cy=\"24.00\" r=\"4.5\" fill=\"#c22f1d\""));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"26.00\" cy=\"456.00\" r=\"3\" fill=\"#1f5fa8\""));
}

/// A tetrahedron with its fronts outside, that has moved up.
RunView tetrahedron() {
  RunView view;
  view.nodes = 4;
  view.pinned = {false, false, false, false};
  for (const std::array<std::uint32_t, 3>& t :
       {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    view.triangles.push_back({ViewCorner{t[0], 0, 0}, {t[1], 0, 0}, {t[2], 0, 0}});
  view.frames = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 2}};
  return view;
}

// Where nothing of a back can be seen none is drawn: order by depth would let some shine through.
TEST(MeshPicture, ASolidShowsNoBacks) {
  const auto faces = [](const RunView& view) { return count(drawn(view), "Z\" fill=\"#"); };
  RunView view = tetrahedron();
  const std::size_t seen = faces(view);
  EXPECT_GT(seen, 0u);
  EXPECT_LT(seen, 4u);
  for (auto& t : view.triangles) std::swap(t[0], t[1]); // inside out: no solid, all four
  EXPECT_EQ(faces(view), 4u);
  view = tetrahedron();
  view.triangles.pop_back(); // with a rim
  EXPECT_EQ(faces(view), 3u);
}

TEST(MeshPicture, WhatHasNotMovedHasNoStart) {
  RunView view = pendulum();
  view.frames[1] = view.frames[0];
  EXPECT_THAT(drawn(view), Not(HasSubstr("#b4bfcc")));
}

TEST(MeshPicture, WhatIsNoNumberIsLeftOut) {
  RunView view = pendulum();
  view.frames[1][3] = NAN;
  view.frames[0][4] = INFINITY;
  const std::string svg = drawn(view);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_EQ(count(svg, "<circle"), 1u);
}

/// Two sheets of n x n squares in planes of their own, `gap` apart: the one behind faces away.
RunView sheets(std::uint32_t n, float gap) {
  RunView view;
  const std::uint32_t row = n + 1;
  view.nodes = 2 * std::size_t{row} * row;
  view.pinned.assign(view.nodes, false);
  view.frames.resize(1);
  for (const float y : {gap, 0.0f}) // up is z, the viewer stands at negative y
    for (std::uint32_t r = 0; r < row; ++r)
      for (std::uint32_t c = 0; c < row; ++c)
        for (const float x : {float(c), y, float(r)}) view.frames[0].push_back(x);
  for (std::uint32_t s = 0; s < 2; ++s)
    for (std::uint32_t r = 0; r < n; ++r)
      for (std::uint32_t c = 0; c < n; ++c) {
        const std::uint32_t a = s * row * row + r * row + c, b = a + 1, d = a + row, e = d + 1;
        const auto face = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
          if (s == 0) std::swap(i, j);
          view.triangles.push_back({{{i, 0, 0}, {j, 0, 0}, {k, 0, 0}}});
        };
        face(a, b, e), face(a, e, d);
      }
  return view;
}

std::string colours_in_order(const std::string& svg) {
  std::string order;
  for (std::size_t at = svg.find("fill=\"#"); at != std::string::npos; at = svg.find("fill=\"#", at + 1)) {
    const std::string rgb = svg.substr(at + 7, 6);
    if (rgb.size() == 6 && svg[at + 13] == '"') order += rgb.substr(0, 2) > rgb.substr(4, 2) ? 'g' : 'b';
  }
  return order;
}

TEST(MeshPicture, TheNearLiesOverTheFarAndABackIsGold) {
  EXPECT_EQ(colours_in_order(drawn(sheets(1, 0.25f))), "ggbb");
  EXPECT_EQ(colours_in_order(drawn(sheets(1, -0.25f))), "bbgg") << "now the one that faces away is nearer";
}

// The page's middle is on the sheet in front, whose faces are drawn last, wherever the mesh's rows end.
TEST(MeshPicture, ACoarseSheetStillHidesTheOneBehind) {
  for (const float gap : {8.0f, -8.0f}) {
    const std::string order = colours_in_order(drawn(sheets(100, gap)));
    EXPECT_EQ(order.back(), gap > 0 ? 'b' : 'g');
    EXPECT_GT(std::count(order.begin(), order.end(), 'b'), 500);
    EXPECT_GT(std::count(order.begin(), order.end(), 'g'), 500);
  }
}

/// Twice the area of the faces of a picture, in square pixels.
double area(const std::string& svg) {
  static const std::regex face(
      "<path d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)Z\" fill");
  double sum = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), face), end; at != end; ++at) {
    const auto p = [&](std::size_t k) { return std::stod((*at)[k]); };
    sum += std::fabs((p(3) - p(1)) * (p(6) - p(2)) - (p(5) - p(1)) * (p(4) - p(2)));
  }
  return sum;
}

// Corners of the sheets move inwards by less than a cube; between faces nothing is left open and nothing is
// doubled.
TEST(MeshPicture, CoarseFacesCoverWhatTheFineOnesCovered) {
  const double fine = area(drawn(sheets(30, 8))), coarse = area(drawn(sheets(240, 64)));
  EXPECT_NEAR(coarse / fine, 1, 0.08);
}

TEST(MeshPicture, AMillionNodesMakeASmallFile) {
  const RunView view = sheets(706, 30); // 999,698 nodes
  ASSERT_GT(view.triangles.size(), 1'900'000u);
  const std::string svg = drawn(view);
  EXPECT_LT(svg.size(), 1u << 20);
  EXPECT_LE(count(svg, "<path"), most_shapes);
  EXPECT_GT(count(svg, "<path"), most_shapes / 4);
  EXPECT_EQ(count(drawn(sheets(31, 1)), "<path"), 4u * 31 * 31) << "a mesh of few shapes is drawn as it is";
}

// Springs alone, all nodes in one place, and places that are no numbers.
TEST(MeshPicture, AnyLargeMeshHasAPicture) {
  RunView view = sheets(100, 8);
  view.triangles.clear();
  for (std::uint32_t n = 0; n + 1 < view.nodes; ++n) view.springs.push_back({{n, n + 1}, 1.0f});
  EXPECT_GT(count(drawn(view), "<path"), 500u);
  view.frames[0][4500] = NAN;
  EXPECT_THAT(drawn(view), Not(HasSubstr("nan")));
  view.frames[0].assign(view.frames[0].size(), 2.0f);
  EXPECT_EQ(count(drawn(view), "<path"), 0u);
}

} // namespace
} // namespace hopmesh::tests
