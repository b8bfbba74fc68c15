// Charts: the Pareto front, what is drawn where, and tables read back.
#include "sim/pictures/svg_chart.h"

#include "sim/files/output_file.h"
#include "sim/pictures/chart_page.h"
#include "sim/pictures/svg_map.h"
#include "tests/pictures/browser.h"
#include "tests/support/files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace pictures;

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Pareto, KeepsWhatNobodyBeatsInBoth) {
  std::vector<ChartPoint> points;
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{3, 1}, {1, 4}, {2, 4}, {2, 2}, {4, 1}, {1, 5}})
    points.push_back({x, y, false, "", ""});
  std::vector<std::pair<double, double>> found;
  for (const ChartPoint& p : pareto_front(points)) found.emplace_back(p.x, p.y);
  EXPECT_EQ(found, (std::vector<std::pair<double, double>>{{1, 4}, {2, 2}, {3, 1}}));
}

TEST(SvgChart, FailedPointsAreHollowAndZerosAreCounted) {
  Chart chart;
  chart.series = {{"a<b",
                   {{{1, 1, false, "one", "run <1>"},
                     {10, 0.1, false, "", ""},
                     {0, 1, false, "", ""},
                     {0, 2, true, "", ""}}}}};
  chart.lines = {{0.5, "floor"}};
  const std::string svg = svg_of(chart);
  EXPECT_EQ(count_of(svg, "class=\"point\""), 2u);
  EXPECT_EQ(count_of(svg, "class=\"point failed\""), 1u);
  EXPECT_THAT(svg, HasSubstr("1 points have no place here"));
  EXPECT_EQ(count_of(svg, "\"></text>"), 0u) << "lines without a number";
  EXPECT_THAT(svg, HasSubstr("a&lt;b"));
  EXPECT_THAT(svg, HasSubstr("data-command=\"run &lt;1&gt;\""));
  EXPECT_THAT(svg, HasSubstr(">floor</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg_of(Chart{}), Not(HasSubstr("nan"))) << "nothing to draw";
}

TEST(SvgChart, LabelsStandAtMarksWhereThereIsRoom) {
  Chart chart;
  chart.labels = "width";
  ChartPoint eight{1, 1, false, "", ""}, sixteen{0.01, 2, false, "", ""};
  eight.label = "8", sixteen.label = "16";
  chart.series = {{"one", {{eight, sixteen}}}};
  for (int k = 0; k < 9; ++k) chart.series[0].ladders.push_back({eight}); // all in one place
  const std::string svg = svg_of(chart);
  EXPECT_EQ(count_of(svg, ">16</text>"), 1u);
  EXPECT_EQ(count_of(svg, ">8</text>"), 4u) << "one in each corner of the mark, no more";
  EXPECT_THAT(svg, HasSubstr(">at marks: width</text>"));
}

TEST(SvgChart, ASeriesWithoutAMarkIsNotInTheLegend) {
  Chart chart;
  chart.series = {{"nobody", {{{0, 1, false, "", ""}}}}, {"somebody", {{{1, 1, false, "", ""}}}}};
  const std::string svg = svg_of(chart);
  EXPECT_THAT(svg, Not(HasSubstr(">nobody</text>")));
  EXPECT_THAT(svg, HasSubstr(">somebody</text>"));
}

TEST(SvgChart, MarksOfAnotherKindAreSquaresThatTheLegendTells) {
  Chart chart;
  const ChartPoint failed{0, 2, true, "", ""};
  chart.series = {{"core", {{{1, 1, false, "", ""}}}}, {"array", {{{2, 1, false, "", ""}, failed}}, true}};
  chart.keys = {"squares: another clock"};
  const std::string svg = svg_of(chart);
  EXPECT_EQ(count_of(svg, "<circle "), 2u) << "a mark, and its place in the legend";
  EXPECT_EQ(count_of(svg, "</circle>"), 1u);
  EXPECT_EQ(count_of(svg, "width=\"10\" height=\"10\""), 3u);
  EXPECT_EQ(count_of(svg, "class=\"point failed\""), 1u);
  EXPECT_THAT(svg, HasSubstr(">squares: another clock</text>"));
}

TEST(SvgChart, BarsReachFromTheLeastToTheLargest) {
  Chart chart;
  ChartPoint wide{1, 1, false, "", ""}, from_zero{2, 1, false, "", ""}, alone{3, 1, false, "", ""};
  wide.across = {0.5, 2}, wide.up = {0.5, 2};
  from_zero.across = {0, 4}, from_zero.up = {1, 1};
  alone.across = {3, 3};
  chart.series = {{"one", {{wide, from_zero, alone}}}};
  chart.notes = {"first note", "second note"};
  const std::string svg = svg_of(chart);
  EXPECT_EQ(count_of(svg, "class=\"bar\""), 3u) << "two of the first, one of the second to the edge";
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr(">first note</text>"));
  EXPECT_THAT(svg, HasSubstr(">second note</text>"));
}

TEST(SvgChart, CurvesAreLinesThatDashesTellApart) {
  Chart chart;
  chart.curves = true;
  const std::vector<ChartPoint> course{
      {1, 1, false, "", ""}, {2, 0.5, false, "", ""}, {4, 0.1, false, "end", ""}};
  chart.series = {{"one", {course}}, {"two", {course}}};
  const std::string svg = svg_of(chart);
  EXPECT_EQ(count_of(svg, "class=\"point\""), 2u) << "the end of each";
  EXPECT_EQ(count_of(svg, "stroke-dasharray=\"none\""), 2u) << "the line, and its sample in the legend";
  EXPECT_EQ(count_of(svg, "stroke-dasharray=\"8 3\""), 2u);
  EXPECT_THAT(svg, Not(HasSubstr("class=\"front\"")));
  EXPECT_THAT(svg, Not(HasSubstr("order 1")));
}

TEST(SvgMap, PlacesAreLogarithmicBetweenCellsMiddles) {
  EXPECT_DOUBLE_EQ(place_among({1, 10, 100}, 1), 0.5);
  EXPECT_DOUBLE_EQ(place_among({1, 10, 100}, 100), 2.5);
  EXPECT_NEAR(place_among({1, 10, 100}, std::sqrt(10.0)), 1.0, 1e-12);
  EXPECT_NEAR(place_among({1, 10, 100}, 1000), 3.5, 1e-12);
  EXPECT_NEAR(place_among({0, 10}, 5), 1.0, 1e-12) << "linear where a value is 0";
}

TEST(SvgMap, TheLegendSaysWhichLinesNobodySees) {
  CellMap map{"m", "x", "y", {1, 2, 4}, {1, 2}, {{"stable", "#123456"}}, {}};
  const std::vector<std::vector<MapCell>> cells(2, std::vector<MapCell>(3));
  map.panels.push_back({"p", cells, {{"near", {{2, 1}, {2, 2}}}, {"far", {{50, 1}, {60, 2}}}}});
  const std::string svg = svg_of(map);
  EXPECT_NE(svg.find(">near</text>"), std::string::npos);
  EXPECT_NE(svg.find(">far (beyond the map)</text>"), std::string::npos);
}

TEST(SvgMap, HasACellAPoint) {
  CellMap map{"m", "x", "y", {1, 2}, {1, 2, 3}, {{"stable", "#123456"}}, {}};
  map.panels.push_back({"p", std::vector<std::vector<MapCell>>(3, std::vector<MapCell>(2)), {}});
  EXPECT_EQ(count_of(svg_of(map), "class=\"cell\""), 6u);
}

TEST(CsvTable, ReadsQuotesLineBreaksAndNumbers) {
  const files::CsvTable t = files::parse_csv("a,b\n1,\"x, \"\"y\"\"\nz\"\n,inf\n", "t.csv");
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.text(0, "b"), "x, \"y\"\nz");
  EXPECT_EQ(t.number(0, "a"), 1.0);
  EXPECT_EQ(t.number(1, "a"), std::nullopt);
  EXPECT_EQ(t.number(1, "b"), std::nullopt);
  EXPECT_THROW(files::parse_csv("a,b\n1\n", "t.csv"), std::runtime_error);
}

TEST(ChartPage, ShowsTheTableAndNoForeignMarkup) {
  const std::string page = chart_page("<t>", "<svg/>", files::parse_csv("a\n<script>\n", "t"));
  EXPECT_THAT(page, HasSubstr("<td>&lt;script&gt;</td>"));
  EXPECT_THAT(page, HasSubstr("<title>&lt;t&gt;</title>"));
}

// As a user's browser does it: to point at a mark tells its settings and its command, a click keeps them.
TEST(ChartPage, PointingAtAMarkTellsTheCommandThatRepeatsIt) {
  if (!browser_present()) GTEST_SKIP() << "chromium is not installed";
  Chart chart;
  chart.series = {{"engine",
                   {{{1e-3, 1, false, "width 8\nhopmesh run a <b>", "hopmesh run a <b>"},
                     {1e-4, 2, false, "width 16\nhopmesh run c", "hopmesh run c"}}}}};
  std::string page = chart_page("t", svg_of(chart), files::parse_csv("a\n1\n", "t"));
  page.replace(page.rfind("</body>"), 7, R"(<script>
    const marks = document.querySelectorAll('[data-command]'), html = document.documentElement;
    const told = () => [tip.firstChild.textContent, tip.querySelector('code').textContent].join('|');
    marks[0].dispatchEvent(new MouseEvent('mouseenter'));
    html.dataset.first = told();
    marks[1].dispatchEvent(new MouseEvent('click', { bubbles: true }));
    marks[0].dispatchEvent(new MouseEvent('mouseenter'));
    html.dataset.kept = told();
    document.body.click();
    marks[0].dispatchEvent(new MouseEvent('mouseenter'));
    html.dataset.free = told();</script></body>)");
  const Folder folder;
  files::write_file(folder / "chart.html", page);
  const BrowserVisit seen = visit(folder / "chart.html");
  EXPECT_THAT(seen.console, ::testing::IsEmpty());
  EXPECT_THAT(seen.dom, HasSubstr("data-first=\"width 8|hopmesh run a &lt;b&gt;\""));
  EXPECT_THAT(seen.dom, HasSubstr("data-kept=\"width 16|hopmesh run c\""));
  EXPECT_THAT(seen.dom, HasSubstr("data-free=\"width 8|hopmesh run a &lt;b&gt;\""));
}

} // namespace
} // namespace hopmesh::tests
