// What a row of the table of levels says is what the program does with that level; and no verb takes a name
// that the table does not have.
#include "tests/cli/levels_by_name.h"
#include "tests/support/cli_test.h"

#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Four free nodes in a row between pinned ones, with enough to do.
const std::string row = "two-nodes --set mesh.grid.columns=6 --set force.wind=[0.3,0.1,0] --steps 2";

class CliLevel : public Cli, public ::testing::WithParamInterface<std::string> {
 protected:
  // What takes a while is made before anything is looked at.
  void SetUp() override {
    if (!level.make_ready) return;
    if (run_shell("command -v verilator > /dev/null").exit_code != 0) GTEST_SKIP() << "no verilator here";
    around.environment.emplace_back("HOPMESH_CACHE", HOPMESH_RTL_CACHE);
    around.patience_seconds = 280;
    ASSERT_EQ(hopmesh("run two-nodes --steps 1 --out made" + named).exit_code, 0);
  }

  const levels::Level& level = levels::level_named(GetParam(), "");
  const std::string array = array_for(GetParam());
  const std::string named = " --level " + GetParam() + array;
  const bool is_rival = level.kind == levels::Kind::rival;

  /// Exit 2 and a line with both texts.
  void expect_refused(const std::string& line, const std::string& where) const {
    const Finished f = hopmesh(line);
    EXPECT_EQ(f.exit_code, 2) << line;
    EXPECT_THAT(f.err, HasSubstr(where + ": found " + GetParam() + ", expected ")) << line;
  }
};

INSTANTIATE_TEST_SUITE_P(Of, CliLevel, ::testing::ValuesIn(levels::level_names()), name_of_level);

TEST_P(CliLevel, HasCodesAndABusAsTheRowSays) {
  const fs::path r = results_of(row + named, "r");
  EXPECT_EQ(fs::exists(r / "outputs_raw.npy"), level.has_codes());
  EXPECT_EQ(read_json(r / "manifest.json")["array"].is_string(), level.has_codes());
  const Table steps = read_table(r / "steps.csv");
  EXPECT_EQ(steps.numbers("cycles")[0] > 0, level.has_codes());
  EXPECT_EQ(steps.numbers("bus_cycles")[0] > 0, level.has_bus());
  EXPECT_EQ(steps.numbers("sweeps")[0] > 0, !is_rival);
}

TEST_P(CliLevel, AsksTheReferenceAsTheRowSays) {
  const auto asked = [&](const std::string& flag, const std::string& out) {
    return read_table(results_of(row + named + flag, out) / "steps.csv").column.at("output_error_rms")[0] !=
           "";
  };
  EXPECT_EQ(asked("", "r"), level.has_codes() && level.checked);
  EXPECT_EQ(asked(" --check", "c"), level.has_codes());
  EXPECT_FALSE(asked(" --no-check", "n"));
}

TEST_P(CliLevel, MakesAWaveAsTheRowSays) {
  const Finished f = hopmesh("run " + row + named + " --wave w.vcd --wave-window 0:1 --out r");
  EXPECT_EQ(f.exit_code, level.can_wave ? 0 : 2) << f.err;
  EXPECT_EQ(fs::exists(at("w.vcd")), level.can_wave);
  EXPECT_EQ(fs::exists(at("r")), level.can_wave);
  if (!level.can_wave) {
    EXPECT_EQ(f.err, "hopmesh: --wave: found level " + GetParam() +
                         ", expected a level of the array: only those have signals\n");
  }
}

TEST_P(CliLevel, IsComparedUnlessItIsARival) {
  const std::string other =
      level.kind == levels::Kind::reference ? levels::default_level().name : levels::compared_names().front();
  const std::string line = "compare " + row + array + " --levels " + GetParam() + "," + other;
  if (is_rival) return expect_refused(line, "--levels");
  const Finished f = good(line);
  EXPECT_THAT(f.out, HasSubstr("\n" + GetParam() + ": "));
}

TEST_P(CliLevel, SolvesNetworksUnlessItIsARival) {
  if (is_rival) return expect_refused("solve two-neurons" + named, "--level");
  EXPECT_THAT(good("solve two-neurons" + named).out, HasSubstr("level " + GetParam() + ","));
}

TEST_P(CliLevel, AnswersVectorsAndCampaignsWhereItHasABus) {
  if (!level.has_bus()) {
    expect_refused("vectors --random 3 --out v.txt" + named, "--level");
    return expect_refused("fuzz --cases 3 --levels " + GetParam() + "," + levels::default_level().name,
                          "--levels");
  }
  good((level.make_ready ? "vectors two-nodes --step 1 --out v.txt" : "vectors --random 3 --out v.txt") +
       named);
  EXPECT_EQ(hopmesh("vectors --check v.txt").exit_code, 0); // the default level agrees
}

TEST_P(CliLevel, IsNamedByTheHelpOfWhoeverTakesIt) {
  const auto offered = [&](const char* verb) {
    const std::string help = good(std::string(verb) + " --help").out;
    return std::regex_search(help, std::regex("[ ,(]" + GetParam() + "[ ,:)\n]"));
  };
  EXPECT_TRUE(offered("run"));
  for (const char* verb : {"compare", "solve"}) EXPECT_EQ(offered(verb), !is_rival) << verb;
  for (const char* verb : {"fuzz", "vectors"}) EXPECT_EQ(offered(verb), level.has_bus()) << verb;
}

TEST_P(CliLevel, IsAMethodOfStudies) {
  const std::string folded = level.make_ready ? "array = \"folded\"\n" : "";
  write_text(at("study.toml"), "scene = \"two-nodes\"\n" + folded + "steps = 2\nmethods = [\"" + GetParam() +
                                   "\"]\n[axes]\n" + "\"motion.time_step\" = [0.05]\n");
  const Finished f = hopmesh("sweep study.toml --out s");
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(read_table(at("s/results.csv")).column.at("status")[0], "finished");
}

TEST_F(Cli, AnUnknownLevelIsAnErrorEverywhere) {
  write_text(at("study.toml"),
             "scene = \"two-nodes\"\nmethods = [\"sytemc\"]\n[axes]\n\"motion.time_step\" = [0.05]\n");
  for (const char* line :
       {"run two-nodes --level sytemc", "compare two-nodes --levels reference,sytemc",
        "solve two-neurons --level sytemc", "vectors --random 1 --out v --level sytemc",
        "vectors --check v --level sytemc", "fuzz --cases 1 --levels engine,sytemc", "sweep study.toml"}) {
    const Finished f = hopmesh(line);
    EXPECT_EQ(f.exit_code, 2) << line;
    EXPECT_THAT(f.err, ::testing::ContainsRegex("found \"?sytemc\"?, expected ")) << line;
    EXPECT_THAT(f.err, HasSubstr("(did you mean systemc?)")) << line;
  }
}

} // namespace
} // namespace hopmesh::tests
