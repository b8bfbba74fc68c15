// hopmesh chart: what its picture says, whom it leaves out and tells, points over an axis as one mark.
#include "tests/support/cli_test.h"

#include <algorithm>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliChart : public Cli {
 protected:
  std::string svg(const std::string& folder) const { return content_of(at(folder) / "chart.svg"); }

  static std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto place = text.find(part); place != std::string::npos; place = text.find(part, place + 1))
      ++count;
    return count;
  }
};

// The tour's chart: which bit buys what?
TEST_F(CliChart, OfTheFirstStudyAnswersItsQuestion) {
  good("sweep first-widths --out widths");
  const Finished f = good("chart widths");
  EXPECT_THAT(f.out, HasSubstr("20 points: hardware_seconds against position_error"));
  EXPECT_THAT(f.out, HasSubstr("Not drawn: 10 points of reference, without hardware_seconds\n"));
  const std::string chart = svg("widths");
  EXPECT_THAT(chart, HasSubstr(">first-widths: speed against accuracy</text>"))
      << "the study, not the folder";
  EXPECT_THAT(chart, HasSubstr(">relax.threshold 0.01</text>"));
  EXPECT_THAT(chart, HasSubstr(">at marks: width</text>"));
  for (const char* width : {">8</text>", ">10</text>", ">12</text>", ">14</text>", ">16</text>"})
    EXPECT_THAT(chart, HasSubstr("class=\"label\"")) << width;
  EXPECT_GE(count_of(chart, "class=\"label\""), 8u) << "two may stand in another's way";
  EXPECT_THAT(chart, Not(HasSubstr(">reference</text>"))) << "a name without a mark";
  EXPECT_EQ(count_of(chart, "class=\"point\""), 10u);
}

TEST_F(CliChart, TwoViewsDoNotOverwriteEachOther) {
  good("sweep first-widths --out w");
  good("chart w");
  const std::string before = svg("w");
  EXPECT_THAT(good("chart w --x position_error --y memory_bits --out view/memory").out,
              HasSubstr("view/memory/chart.svg"));
  EXPECT_EQ(svg("w"), before);
  EXPECT_THAT(svg("view/memory"), HasSubstr(">memory_bits</text>"));
  EXPECT_THAT(refused("chart w --out /proc/none"), HasSubstr("/proc/none"));
}

TEST_F(CliChart, IntegratorsThatCompeteAreTimedHere) {
  write_text(at("s.toml"), "scene = \"banner\"\nsteps = 4\nmethods = [\"engine\", \"rk4\"]\n[axes]\n"
                           "\"motion.time_step\" = [0.001, 0.002]\n\"mesh.grid.rows\" = [4]\n");
  good("sweep s.toml --out r");
  EXPECT_THAT(good("chart r").out, HasSubstr("host_seconds against"));
  const std::string chart = svg("r");
  EXPECT_EQ(count_of(chart, "<circle "), 4u + 2u) << "both methods on this processor, and the legend";
  EXPECT_EQ(count_of(chart, "width=\"10\" height=\"10\""), 2u + 1u)
      << "the array on hardware, and the legend";
  EXPECT_THAT(chart, HasSubstr(">engine, on hardware</text>"));
  EXPECT_THAT(chart, HasSubstr("(hardware_seconds)</text>"));
  const Table t = read_table(at("r") / "results.csv");
  EXPECT_THAT(chart, HasSubstr("hardware_seconds: " + t.column.at("hardware_seconds")[0]));
  EXPECT_THAT(good("chart r --y sweeps --out v").out, HasSubstr("sweeps against"));
  EXPECT_THAT(svg("v"), Not(HasSubstr("on hardware"))) << "sweeps are no time";
}

TEST_F(CliChart, OverSeedsAMarkIsTheMedianWithItsSpread) {
  write_text(at("s.toml"), "name = \"seeds\"\nscene = \"random-start\"\nsteps = 4\n[axes]\n"
                           "\"mesh.start.seed\" = [1, 2, 3]\n\"relax.threshold\" = [1e-2, 1e-4]\n");
  good("sweep s.toml --out r");
  const Finished f = good("chart r --over mesh.start.seed --x position_error --y sweeps --out v");
  EXPECT_THAT(f.out, HasSubstr("A mark is the median over mesh.start.seed"));
  EXPECT_EQ(count_of(svg("v"), "class=\"point\""), 2u);
  EXPECT_GE(count_of(svg("v"), "class=\"bar\""), 2u);
  const Table all = read_table(at("r") / "results.csv"), spread = read_table(at("v") / "spread.csv");
  ASSERT_EQ(spread.rows(), 2u);
  EXPECT_EQ(spread.header[1], "relax.threshold");
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> errors;
    for (std::size_t row = 0; row < all.rows(); ++row)
      if (all.column.at("relax.threshold")[row] == spread.column.at("relax.threshold")[k])
        errors.push_back(all.numbers("position_error")[row]);
    std::sort(errors.begin(), errors.end());
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_EQ(spread.numbers("position_error_least")[k], errors[0]);
    EXPECT_EQ(spread.numbers("position_error_median")[k], errors[1]);
    EXPECT_EQ(spread.numbers("position_error_largest")[k], errors[2]);
  }
  refused("chart r --over mesh.start.sed", "--over: found mesh.start.sed, expected an axis of the study");
  refused("chart r --over method", "--over: found method");
}

// Array and bus together: with it, a wide bus is worth what it is worth.
TEST_F(CliChart, HardwareSecondsHaveTheBusInThem) {
  write_text(at("s.toml"), "scene = \"two-nodes\"\nsteps = 3\nmethods = [\"reference\", \"engine\"]\n[axes]\n"
                           "\"array.bus_bits\" = [32, 64]\n\"array.clock_mhz\" = [200.0]\n");
  good("sweep s.toml --out r");
  const Table t = read_table(at("r") / "results.csv");
  EXPECT_EQ(t.column.at("hardware_seconds")[0], "") << "the reference is no hardware";
  const auto seconds = [&](std::size_t row) { return std::stod(t.column.at("hardware_seconds")[row]); };
  for (const std::size_t row : {2, 3}) {
    const double cycles = t.numbers("cycles")[row] + t.numbers("bus_cycles")[row];
    EXPECT_DOUBLE_EQ(seconds(row), cycles / 200e6);
    EXPECT_LT(t.numbers("array_seconds")[row], seconds(row));
  }
  EXPECT_LT(seconds(3), seconds(2));
}

} // namespace
} // namespace hopmesh::tests
