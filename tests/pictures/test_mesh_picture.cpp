// picture.svg: what lies where, what hides what, and that no mesh makes a large file.
#include "sim/pictures/mesh_picture.h"

#include "sim/pictures/mesh_bitmap.h"
#include "tests/support/folder.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace hopmesh::pictures {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string drawn(const RunView& view) {
  const tests::Folder folder;
  write_mesh_picture(view, folder / "picture.svg");
  std::ifstream file(folder / "picture.svg");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// One pinned node, one that comes down from 1 beside it to 4 under it.
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

TEST(MeshPicture, ABitmapShowsTheNearestToo) {
  for (const float gap : {0.25f, -0.25f}) {
    const RunView view = sheets(8, gap);
    const MeshShapes shapes(view);
    const files::Picture picture = bitmap_of(shapes, 1, 0);
    const std::size_t middle = (std::size_t{picture.height} / 2 * picture.width + picture.width / 2) * 4;
    EXPECT_EQ(picture.rgba[middle]<picture.rgba[middle + 2], gap> 0) << "blue before gold";
    EXPECT_EQ(picture.rgba[0], 255) << "paper";
  }
}

// No pixel between faces stays paper: along the middle row, everything from the first to the last is painted.
TEST(MeshPicture, FacesOfABitmapLeaveNoGap) {
  const RunView view = sheets(200, 1);
  const MeshShapes shapes(view);
  const files::Picture picture = bitmap_of(shapes, 2, 0);
  std::string row;
  for (std::size_t x = 0; x < picture.width; ++x)
    row += picture.rgba[(std::size_t{picture.height} / 2 * picture.width + x) * 4] == 255 ? ' ' : '#';
  const std::size_t first = row.find('#'), last = row.rfind('#');
  ASSERT_LT(first + 100, last);
  EXPECT_EQ(row.substr(first, last - first).find(' '), std::string::npos);
}

TEST(MeshPicture, AMillionNodesMakeASmallFile) {
  const RunView view = sheets(706, 30); // 999,698 nodes
  ASSERT_GT(view.triangles.size(), 1'900'000u);
  const std::string svg = drawn(view);
  EXPECT_THAT(svg.substr(0, 400), HasSubstr("href=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_LT(svg.size(), 2u << 20);
  EXPECT_EQ(count(drawn(sheets(31, 1)), "<path"), 4u * 31 * 31) << "few are vectors";
}

} // namespace
} // namespace hopmesh::pictures
