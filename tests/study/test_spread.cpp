// Points of a study that differ only along some axes as one mark: middle, least and largest.
#include "sim/input/input_error.h"
#include "sim/study/spread.h"
#include "tests/support/complaint.h"
#include "tests/support/results.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace study;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two widths, three seeds, two methods; a seed failed, and the reference has no cycles.
files::CsvTable table() {
  return files::parse_csv("point,seed,width,method,status,error,cycles\n"
                          "0,1,8,engine,finished,4,10\n"
                          "1,2,8,engine,finished,1,30\n"
                          "2,3,8,engine,finished,3,20\n"
                          "3,1,12,engine,finished,0.5,11\n"
                          "4,2,12,engine,diverged,,31\n"
                          "5,3,12,engine,finished,0.25,21\n"
                          "6,1,8,reference,finished,2,\n",
                          "results.csv");
}

TEST(SpreadOf, IsLeastMiddleAndLargest) {
  const Spread odd = spread_of({4, 1, 3}), even = spread_of({4, 1, 3, 2}), one = spread_of({7});
  EXPECT_EQ(odd.least, 1);
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.largest, 4);
  EXPECT_EQ(even.median, 2.5) << "the mean of the two in the middle";
  EXPECT_EQ(spread_of({1e308, 1.5e308}).median, 1.25e308) << "their sum is too large for a double";
  EXPECT_EQ(one.least, 7);
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.largest, 7);
}

TEST(AxisColumns, NeedAPointsNumberBeforeTheMethod) {
  for (const char* text : {"method,status\nengine,finished\n", "point,status\n0,finished\n"}) {
    const files::CsvTable broken = files::parse_csv(text, "results.csv");
    EXPECT_THAT(complaint([&] { axis_columns(broken, {}); }), HasSubstr("results.csv:1: found "));
  }
}

TEST(AxisColumns, AreWhatStandsBetweenPointAndMethod) {
  const AxisColumns axes = axis_columns(table(), {"seed"});
  EXPECT_THAT(axes.kept, ElementsAre(2));
  EXPECT_THAT(axes.over, ElementsAre(1));
  EXPECT_EQ(axes.method, 3u);
  for (const char* none : {"method", "point", "error", "sed"}) {
    try {
      axis_columns(table(), {none});
      ADD_FAILURE() << none;
    } catch (const input::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--over: found " + std::string(none))) << none;
      EXPECT_THAT(error.what(), HasSubstr("an axis of the study: seed, width")) << none;
    }
  }
}

TEST(GroupsOf, AreEqualInMethodAndAllOtherAxes) {
  const files::CsvTable t = table();
  const auto groups = groups_of(t, axis_columns(t, {"seed"}), "error", "cycles");
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_THAT(groups[0].rows, ElementsAre(0, 1, 2));
  EXPECT_EQ(groups[0].x.median, 3);
  EXPECT_EQ(groups[0].y.median, 20);
  EXPECT_EQ(groups[0].middle, 2u);
  EXPECT_THAT(groups[1].rows, ElementsAre(3, 4, 5));
  EXPECT_THAT(groups[1].told, ElementsAre(3, 5)) << "one diverged";
  EXPECT_EQ(groups[1].x.median, 0.375);
  EXPECT_THAT(groups[2].told, ElementsAre()) << "no cycles";
}

TEST(GroupsOf, WithoutAnAxisEveryPointIsItsOwn) {
  const files::CsvTable t = table();
  EXPECT_EQ(groups_of(t, axis_columns(t, {}), "error", "cycles").size(), t.rows.size());
}

TEST(WriteSpread, HasARowAGroup) {
  const Folder folder;
  const files::CsvTable t = table();
  const AxisColumns axes = axis_columns(t, {"seed"});
  write_spread(folder / "spread.csv", t, axes, groups_of(t, axes, "error", "cycles"), "error", "cycles");
  EXPECT_EQ(content_of(folder / "spread.csv"),
            "method,width,points,told,error_median,error_least,error_largest,cycles_median,cycles_least,"
            "cycles_largest\n"
            "engine,8,3,3,3,1,4,20,10,30\n"
            "engine,12,3,2,0.375,0.25,0.5,16,11,21\n"
            "reference,8,1,0,,,,,,\n");
}

} // namespace
} // namespace hopmesh::tests
