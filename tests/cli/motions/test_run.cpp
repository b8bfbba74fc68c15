// hopmesh run: every flag has the effect that its help text promises.
#include "tests/support/cli_test.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class CliRun : public Cli {};

TEST_F(CliRun, WritesEveryFileAndTellsTheSpeeds) {
  const Finished f = good("run two-nodes --out r");
  EXPECT_EQ(names_in(at("r")),
            (std::vector<std::string>{"manifest.json", "mesh.glb", "outputs_raw.npy", "picture.svg",
                                      "positions.npy", "report.html", "stats.json", "steps.csv"}));
  EXPECT_EQ(fault_of_results(at("r"), 40), "");
  EXPECT_THAT(f.out, HasSubstr("two-nodes: All 40 steps done.\n"));
  for (const char* figure : {"wall time", "steps/s", "simulated cycles/s", "Results\n  r\n"})
    EXPECT_THAT(f.out, HasSubstr(figure));
}

TEST_F(CliRun, GoesToAFolderNamedAfterTheSceneByDefault) {
  good("run two-nodes --steps 1");
  EXPECT_EQ(fault_of_results(at("out/two-nodes"), 1), "");
}

TEST_F(CliRun, ANameWithSlashesLeadsNowhereElse) {
  good("run two-nodes --steps 1 --set name=../../else");
  good("run two-nodes --steps 1 --set name=..");
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{"out"});
  EXPECT_EQ(names_in(at("out")), (std::vector<std::string>{"..-..-else", "scene"}));
}

TEST_F(CliRun, OutMayHoldSpacesAndNewFolders) {
  good("run two-nodes --steps 1 --out 'my runs/the first one'");
  EXPECT_EQ(fault_of_results(at("my runs/the first one"), 1), "");
}

TEST_F(CliRun, OverwritesAnEarlierRun) {
  results_of("two-nodes --steps 3", "r");
  EXPECT_EQ(fault_of_results(results_of("two-nodes --steps 2", "r"), 2), "");
}

TEST_F(CliRun, StepsReplaceTheScenes) {
  EXPECT_EQ(read_table(results_of("two-nodes --steps 7", "r") / "steps.csv").rows(), 7u);
  EXPECT_EQ(read_table(results_of("two-nodes --steps 43", "r") / "steps.csv").rows(), 43u);
}

TEST_F(CliRun, LevelReferenceHasNoCodesAndNoCycles) {
  const fs::path r = results_of("two-nodes --level reference", "r");
  EXPECT_EQ(fault_of_results(r, 40, false), "");
  for (double cycles : read_table(r / "steps.csv").numbers("cycles")) EXPECT_EQ(cycles, 0);
  EXPECT_EQ(read_json(r / "manifest.json")["level"], "reference");
  EXPECT_TRUE(read_json(r / "manifest.json")["array"].is_null());
  EXPECT_FALSE(read_json(r / "stats.json").contains("array_cycles"));
}

TEST_F(CliRun, LevelsEngineSystemcAndSystemcClockGiveTheSameBits) {
  const fs::path by_default = results_of("two-nodes --check", "d"),
                 named = results_of("two-nodes --level systemc", "s"),
                 clock = results_of("two-nodes --level systemc-clock", "c");
  expect_same_bits(by_default, named);
  expect_same_bits(named, clock);
  EXPECT_EQ(read_json(by_default / "manifest.json")["level"], "engine");
  EXPECT_EQ(read_json(clock / "manifest.json")["level"], "systemc-clock");
}

TEST_F(CliRun, ThreadsChangeNoBit) {
  const std::string line = "flag-225 --steps 3 ";
  expect_same_bits(results_of(line + "-j 1", "a"), results_of(line + "-j 3", "b"));
}

TEST_F(CliRun, AnArrayWithoutAFastKernelSaysSoOnceAndGivesTheSameBits) {
  const std::string line =
      " two-nodes --steps 3 --check --set 'formats.weight=fixed<24,1,SC_RND,SC_SAT>' --out ";
  const Finished f = hopmesh("run" + line + "e");
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const std::string notice = "no fast kernel for weights of more than 16 bits";
  ASSERT_THAT(f.err, HasSubstr(notice));
  EXPECT_EQ(f.err.find(notice), f.err.rfind(notice));
  good("run --level systemc" + line + "s");
  expect_same_bits(at("e"), at("s"));
}

TEST_F(CliRun, TheReferenceIsNearTheArrayButNotTheSame) {
  const auto a = read_array(results_of("two-nodes --level reference", "a") / "positions.npy").values;
  const auto b = read_array(results_of("two-nodes", "b") / "positions.npy").values;
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  EXPECT_GT(largest, 0);
  EXPECT_LT(largest, 1e-4); // 2 s of a pendulum, 16 bits on the links
}

TEST_F(CliRun, ArrayTakesPresetsAndFiles) {
  const fs::path by_default = results_of("two-nodes", "d"),
                 guarded = results_of("two-nodes --array guarded", "g"),
                 byte = results_of("two-nodes --array byte", "b");
  expect_same_bits(by_default, guarded);
  EXPECT_NE(content_of(guarded / "outputs_raw.npy"), content_of(byte / "outputs_raw.npy"));
  EXPECT_THAT(read_json(byte / "manifest.json")["array"].get<std::string>(), HasSubstr("name = \"byte\""));
  write_text(at("small.toml"), "preset = \"byte\"\n");
  expect_same_bits(byte, results_of("two-nodes --array small.toml", "f"));
}

TEST_F(CliRun, SetChangesTheScene) {
  const fs::path r = results_of("two-nodes --steps 1 --set force.gravity=[0,0,-1]", "r");
  const auto kinetic = read_table(r / "steps.csv").numbers("kinetic");
  EXPECT_NEAR(kinetic[0], 0.5 * 0.05 * 0.05, 1e-7); // v = dt g, m = 1, and the probe's small kick
}

TEST_F(CliRun, SetChangesTheArrayAndItsName) {
  const fs::path one = results_of("two-nodes --steps 3", "1"),
                 three = results_of("two-nodes --steps 3 --set array.lanes=3", "3");
  EXPECT_EQ(content_of(one / "outputs_raw.npy"), content_of(three / "outputs_raw.npy"));
  // Rows of 3 taps: 3 accumulate cycles become 1, in 3 phases a sweep and once in prepare.
  const Table a = read_table(one / "steps.csv"), b = read_table(three / "steps.csv");
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(a.numbers("cycles")[k] - b.numbers("cycles")[k], 2 + 6 * a.numbers("sweeps")[k]);
  EXPECT_THAT(read_json(three / "manifest.json")["array"].get<std::string>(), HasSubstr("name = \"custom\""));
}

TEST_F(CliRun, TheLastSetOfAKeyCounts) {
  const fs::path r = results_of("two-nodes --set motion.steps=9 --set motion.steps=4", "r");
  EXPECT_EQ(read_table(r / "steps.csv").rows(), 4u);
}

TEST_F(CliRun, StepsWinOverSet) {
  EXPECT_EQ(read_table(results_of("two-nodes --steps 4 --set motion.steps=9", "r") / "steps.csv").rows(), 4u);
}

TEST_F(CliRun, NoCheckLeavesTheReferenceOutAndTheBitsAlone) {
  const fs::path with = results_of("two-nodes --level systemc", "w"),
                 without = results_of("two-nodes --level systemc --no-check", "n");
  EXPECT_EQ(content_of(with / "outputs_raw.npy"), content_of(without / "outputs_raw.npy"));
  const Table a = read_table(with / "steps.csv"), b = read_table(without / "steps.csv");
  EXPECT_EQ(a.column.at("hash"), b.column.at("hash"));
  for (const char* name : {"output_error", "output_error_rms", "rounding_error", "stopping_error",
                           "energy_gap", "network_error"})
    for (std::size_t k = 0; k < 40; ++k) {
      EXPECT_NE(a.column.at(name)[k], "") << name;
      EXPECT_EQ(b.column.at(name)[k], "") << name;
    }
  EXPECT_TRUE(read_json(without / "stats.json")["against_reference"].is_null());
  EXPECT_TRUE(read_json(with / "stats.json")["against_reference"].is_object());
}

TEST_F(CliRun, TheEngineAsksTheReferenceOnlyWithCheck) {
  const fs::path with = results_of("two-nodes --check", "w"), without = results_of("two-nodes", "n");
  EXPECT_EQ(read_table(with / "steps.csv").column.at("hash"),
            read_table(without / "steps.csv").column.at("hash"));
  EXPECT_TRUE(read_json(with / "stats.json")["against_reference"].is_object());
  EXPECT_TRUE(read_json(without / "stats.json")["against_reference"].is_null());
}

// In definite networks, every eighth step: what one solve tells is what is measured, and no more than the
// bound.
TEST_F(CliRun, TellsErrorsWithoutARest) {
  const fs::path r = results_of("banner --set mesh.grid.rows=6 --set mesh.grid.columns=6 --steps 17 --check "
                                "--array descent",
                                "r"),
                 probe = results_of("two-nodes --check", "p");
  const Table t = read_table(r / "steps.csv"), none = read_table(probe / "steps.csv");
  for (std::size_t k = 0; k < 17; ++k) {
    const std::string told = t.column.at("told_error")[k], bound = t.column.at("error_bound")[k];
    EXPECT_EQ(told.empty(), k % 8 != 0) << k;
    EXPECT_EQ(bound.empty(), k % 8 != 0) << k;
    if (k % 8 != 0) continue;
    const double measured = std::stod(t.column.at("output_error_rms")[k]);
    EXPECT_NEAR(std::stod(told) / measured, 1, 0.1) << k;
    EXPECT_GE(std::stod(bound), measured) << k;
  }
  for (const std::string& told : none.column.at("told_error")) EXPECT_EQ(told, "");
  const fs::path corrected = results_of("banner --steps 1 --check --set relax.refinements=1", "c");
  const auto told = read_json(corrected / "stats.json")["against_reference"];
  EXPECT_TRUE(told.contains("median_told_error"));
  EXPECT_FALSE(told.contains("median_error_bound")) << "no format bounds a sum of doubles";
  const auto stats = read_json(r / "stats.json")["against_reference"];
  EXPECT_GT(stats["median_error_bound"].get<double>(), stats["median_told_error"].get<double>());
  EXPECT_THAT(content_of(r / "report.html"), ::testing::HasSubstr("output error as one solve tells it"));
}

TEST_F(CliRun, SchedulesDifferInCycles) {
  const std::string line = "two-nodes --set mesh.grid.columns=4 --steps 2 --no-check";
  std::vector<double> per_sweep;
  for (const char* schedule : {"coloured", "sequential", "synchronous"}) {
    const Table t =
        read_table(results_of(line + " --set array.schedule=" + schedule, schedule) / "steps.csv");
    per_sweep.push_back((t.numbers("cycles")[0] - 1) / t.numbers("sweeps")[0]);
  }
  EXPECT_GT(per_sweep[1], per_sweep[0]);
  EXPECT_GT(per_sweep[0], per_sweep[2]);
}

class CliRival : public Cli, public ::testing::WithParamInterface<std::string> {};

TEST_P(CliRival, FliesLikeALevelButHasNoWaves) {
  const std::string line = "banner --set motion.time_step=0.002 --set mesh.grid.rows=5 --level " + GetParam();
  const std::filesystem::path whole = results_of(line + " --steps 12", "whole");
  EXPECT_EQ(fault_of_results(whole, 12, false), "");
  const Finished f = hopmesh("run " + line + " --wave w.vcd");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, ::testing::HasSubstr("--wave: found level " + GetParam()));
}

// An implicit rival may stop early; the array and explicit methods have nothing to do with it.
TEST_F(CliRun, RivalsStopWhereTheSceneSays) {
  const std::string line = "banner --no-check --set mesh.grid.rows=5 --steps 3 --level ";
  const auto flown = [&](const std::string& words, const std::string& folder) {
    return content_of(results_of(line + words, folder) / "positions.npy");
  };
  for (const std::string level :
       {"backward_euler", "bdf2", "linearly_implicit", "projective_dynamics", "engine", "velocity_verlet"}) {
    const bool same = flown(level, level) == flown(level + " --set rival.tolerance=0.01", level + "-early");
    EXPECT_EQ(same, level == "engine" || level == "velocity_verlet") << level;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, CliRival,
                         ::testing::Values("symplectic_euler", "velocity_verlet", "rk4", "backward_euler",
                                           "bdf2", "linearly_implicit", "xpbd", "projective_dynamics"));

} // namespace
} // namespace hopmesh::tests
