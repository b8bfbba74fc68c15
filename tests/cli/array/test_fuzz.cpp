// hopmesh fuzz: flags and their effects. What it does with levels that differ: tests/cosim/test_campaign.cpp.
#include "tests/support/cli_test.h"

#include <csignal>
#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliFuzz : public Cli {};

TEST_F(CliFuzz, CasesAreCountedFromTheFirst) {
  EXPECT_THAT(good("fuzz --cases 40").out, HasSubstr("seed 1, cases 0 to 40: 40 equal, 0 different; "));
  EXPECT_THAT(good("fuzz --cases 5 --seed 7 --first 100").out,
              HasSubstr("seed 7, cases 100 to 105: 5 equal, 0 different; "));
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
}

TEST_F(CliFuzz, SecondsEndIt) {
  const Finished f = good("fuzz --seconds 0.5 --levels engine");
  EXPECT_THAT(f.out, HasSubstr(" equal, 0 different; "));
  EXPECT_LT(f.seconds, 60); // a batch is finished first
}

TEST_F(CliFuzz, SeveralProcessesDoTheSameCases) {
  EXPECT_THAT(good("fuzz --cases 420 -j 3 --levels engine").out, HasSubstr("cases 0 to 420: 420 equal"));
}

TEST_F(CliFuzz, TwoSystemcLevelsAreEnough) {
  EXPECT_THAT(good("fuzz --cases 20 --levels systemc,systemc-clock").out, HasSubstr("20 equal"));
}

TEST_F(CliFuzz, AnInterruptSaysHowToGoOn) {
  around.terminal = true;
  Program program({"fuzz", "--cases", "1000000", "--seed", "4", "--levels", "engine,systemc"}, around);
  ASSERT_TRUE(program.wait_for(" of 1000000 cases"));
  program.send(SIGINT);
  const Finished f = program.finish();
  EXPECT_EQ(f.exit_code, 130);
  static const std::regex shape(
      R"(interrupted; to go on: hopmesh (fuzz --seed 4 --first (\d+) --cases (\d+) --levels engine,systemc)\n)");
  std::smatch part;
  ASSERT_TRUE(std::regex_search(f.out, part, shape)) << f.out;
  EXPECT_EQ(std::stoul(part[2]) + std::stoul(part[3]), 1000000u);
}

TEST_F(CliFuzz, ReplayTakesTheCasesOfAFile) {
  good("vectors --random 4 --seed 3 --blank --out v.txt");
  EXPECT_THAT(good("fuzz --replay v.txt").out, HasSubstr("v.txt: 0 of 4 cases differ"));
}

TEST_F(CliFuzz, OutIsMadeOnlyForAFinding) {
  good("fuzz --cases 3 --out found");
  EXPECT_FALSE(std::filesystem::exists(at("found")));
}

} // namespace
} // namespace hopmesh::tests
