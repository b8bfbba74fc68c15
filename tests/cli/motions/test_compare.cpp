// hopmesh compare: exit codes and figures. What it says of levels that differ: tests/cosim/test_compare.cpp.
#include "tests/support/cli_test.h"

#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string equal = "sweeps, every code; sweep and cycle counts of every step too.";

class CliCompare : public Cli {};

TEST_F(CliCompare, SystemcAndSystemcClockAreEqual) {
  const Finished f = good("compare two-nodes --levels systemc,systemc-clock");
  EXPECT_THAT(f.out, HasSubstr("two-nodes on array guarded, 40 steps."));
  EXPECT_THAT(f.out, HasSubstr(equal));
}

TEST_F(CliCompare, ByDefaultTakesReferenceEngineAndSystemcAndTellsTheError) {
  const Finished f = good("compare two-nodes --steps 10");
  EXPECT_THAT(f.out, HasSubstr("reference: "));
  EXPECT_THAT(f.out, HasSubstr("engine: "));
  EXPECT_THAT(f.out, HasSubstr("systemc: "));
  EXPECT_THAT(f.out, HasSubstr("each step against the reference's rest of the same step"));
  EXPECT_THAT(f.out, HasSubstr("after     1 step   rms "));
  EXPECT_THAT(f.out, HasSubstr("after    10 steps  rms "));
  EXPECT_THAT(f.out, HasSubstr("engine: "));
  EXPECT_THAT(f.out, HasSubstr(equal));
}

TEST_F(CliCompare, OfOneFixedLevelThereIsNothingToBeEqualTo) {
  EXPECT_THAT(good("compare two-nodes --steps 3 --levels reference,systemc").out, Not(HasSubstr(equal)));
}

// The command that a difference prints, with cycles of this run: it has to be one that runs.
TEST_F(CliCompare, TheCommandForAWaveRuns) {
  const Finished f = good("run two-nodes --set array.lanes=3 --level systemc --no-check --steps 5 --out "
                          "out/difference --wave difference.vcd --wave-window 100:160c --wave-cells 0");
  EXPECT_EQ(f.err, "");
  EXPECT_GT(std::filesystem::file_size(at("difference.vcd")), 1000u);
}

TEST_F(CliCompare, TheReferenceNeedNotBeNamedFirst) {
  EXPECT_EQ(good("compare two-nodes --steps 3 --levels systemc,reference").out,
            good("compare two-nodes --steps 3 --levels reference,systemc").out);
}

TEST_F(CliCompare, WithoutTheReferenceThereIsNoErrorToTell) {
  EXPECT_THAT(good("compare two-nodes --steps 3 --levels systemc,systemc-clock").out,
              Not(HasSubstr("against the reference")));
}

TEST_F(CliCompare, StepsAndSetCount) {
  EXPECT_THAT(good("compare two-nodes --steps 3").out, HasSubstr("3 steps."));
  EXPECT_THAT(good("compare two-nodes --set motion.steps=4").out, HasSubstr("4 steps."));
  EXPECT_THAT(good("compare two-nodes --steps 1 --array byte").out, HasSubstr("on array byte"));
}

TEST_F(CliCompare, FiguresAreThoseOfTheRuns) {
  const auto stats = read_json(results_of("two-nodes --steps 7", "r") / "stats.json");
  const std::string out = good("compare two-nodes --steps 7").out;
  const auto grouped = [](std::size_t n) { // of less than a million
    const std::string digits = std::to_string(n);
    return n < 1000 ? digits : digits.substr(0, digits.size() - 3) + ',' + digits.substr(digits.size() - 3);
  };
  EXPECT_THAT(out, HasSubstr("systemc: " + grouped(stats["sweeps"]) + " sweeps, " +
                             grouped(stats["array_cycles"]) + " cycles"));
}

TEST_F(CliCompare, APlanarScene) {
  EXPECT_THAT(
      good("compare two-nodes --steps 5 --set mesh.planar=true --levels reference,systemc,systemc-clock").out,
      HasSubstr(equal));
}

TEST_F(CliCompare, FlagOf225Nodes) {
  const std::string out = good("compare flag-225 --steps 5").out;
  std::smatch part;
  static const std::regex error(R"(weights and biases differ by at most ([0-9.e+-]+) of the largest)");
  ASSERT_TRUE(std::regex_search(out, part, error)) << out;
  EXPECT_LT(std::stod(part[1]), 1e-13); // two programs, one mathematics
  EXPECT_GT(std::stod(part[1]), 0.0);
}

TEST_F(CliCompare, ADivergedMotionIsExitOne) {
  const Finished f =
      hopmesh("compare two-nodes --set force.gravity=[0,0,-1e6] --levels systemc,systemc-clock");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.err, "");
  EXPECT_THAT(f.out, HasSubstr("diverged in step"));
}

} // namespace
} // namespace hopmesh::tests
