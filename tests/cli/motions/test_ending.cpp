// However a run ends - diverged, interrupted, killed, out of disk - what it leaves is whole, and the exit
// code says which it was. And what a terminal sees while it runs.
#include "tests/support/cli_test.h"

#include <csignal>
#include <sys/mount.h>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string long_run = "run flag-400 --level systemc --no-check --out r"; // ten seconds and more

class CliEnding : public Cli {
 protected:
  void expect_refused(const Finished& f, const std::string& says) const {
    EXPECT_EQ(f.exit_code, 2) << f.out;
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(lines_of(f.err).size(), 1u) << f.err;
    EXPECT_THAT(f.err, HasSubstr(says));
  }

  /// A long run at a terminal, interrupted once a step is done.
  Finished interrupted(const std::string& line, int signal) {
    around.terminal = true;
    Program program(words_of(line), around);
    EXPECT_TRUE(program.wait_for("step 1 of"));
    program.send(signal);
    return program.finish();
  }
};

TEST_F(CliEnding, TheLiteralEquationDivergesWithCompleteFiles) {
  const Finished f = hopmesh("run flag-400-literal --no-check --out r");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.err, "");
  EXPECT_THAT(
      lines_of(f.out)[0],
      ::testing::MatchesRegex("flag-400-literal: The motion diverged in step [0-9]+ of 400: a spring is "
                              "[0-9.]+ times its length .the limit is 10.\\. All steps so far are kept\\. "
                              "[0-9]+ of [0-9]+ steps ended at max_sweeps\\."));
  const std::size_t steps = read_json(at("r/stats.json"))["steps"];
  EXPECT_GT(steps, 5u);
  EXPECT_LT(steps, 400u);
  EXPECT_EQ(fault_of_results(at("r"), steps), "");
  EXPECT_EQ(read_json(at("r/manifest.json"))["outcome"], "diverged");
}

/// docs/method/theory.md, section 4: equation 6 as printed, equation 7 as printed, and both.
TEST_F(CliEnding, EachEquationAsPrintedDivergesAndBothDoSoonest) {
  const auto steps_of = [&](const std::string& scene) {
    EXPECT_EQ(hopmesh("run " + scene + " --no-check --out " + scene).exit_code, 1) << scene;
    return read_json(at(scene + "/stats.json"))["steps"].get<int>();
  };
  const int both = steps_of("flag-400-literal"), energies = steps_of("flag-400-letter");
  EXPECT_LT(both, energies);
  EXPECT_LT(energies, steps_of("flag-400-eq7"));
  EXPECT_LE(steps_of("flag-225-letter"), 10);
}

TEST_F(CliEnding, NumbersBeyondDoubleAreDivergenceToo) {
  const Finished f =
      hopmesh("run two-nodes --set force.gravity=[0,0,-1e15] --set motion.time_step=1e15 --out r");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("diverged"));
  EXPECT_EQ(fault_of_results(at("r"), read_json(at("r/stats.json"))["steps"]), "");
}

TEST_F(CliEnding, CtrlCLeavesTheStepsSoFarComplete) {
  for (int signal : {SIGINT, SIGTERM}) {
    const Finished f = interrupted(long_run, signal);
    EXPECT_EQ(f.exit_code, 130);
    const std::size_t steps = read_json(at("r/stats.json"))["steps"];
    EXPECT_GE(steps, 1u);
    EXPECT_LT(steps, 400u);
    EXPECT_EQ(fault_of_results(at("r"), steps), "");
    EXPECT_THAT(f.out, HasSubstr("Interrupted after " + std::to_string(steps) + " of 400 steps"));
    EXPECT_EQ(read_json(at("r/manifest.json"))["outcome"], "interrupted");
  }
}

TEST_F(CliEnding, CtrlCClosesAWave) {
  interrupted(long_run + " --wave w.vcd --wave-cells 0", SIGINT);
  EXPECT_EQ(names_in(around.folder), (std::vector<std::string>{"r", "w.vcd"}));
}

TEST_F(CliEnding, CtrlCEndsACompareAndANetwork) {
  EXPECT_EQ(interrupted("compare flag-400", SIGINT).exit_code, 130);
  EXPECT_EQ(interrupted("network flag-400 --step 399 --out n", SIGINT).exit_code, 130);
  EXPECT_EQ(interrupted("solvers flag-400 --step 399", SIGINT).exit_code, 130);
  EXPECT_TRUE(names_in(at("n")).empty());
}

TEST_F(CliEnding, AKilledRunLeavesNothingUnderAFinalName) {
  const Finished f = interrupted(long_run, SIGKILL);
  EXPECT_EQ(f.signal, SIGKILL);
  for (const std::string& name : names_in(at("r"))) EXPECT_EQ(fs::path(name).extension(), ".part") << name;
  around.terminal = false;
  EXPECT_EQ(fault_of_results(results_of("flag-400 --steps 2 --no-check", "r"), 2),
            ""); // and the next takes over
}

TEST_F(CliEnding, AKilledRunLeavesEarlierResultsAlone) {
  results_of("flag-400 --steps 2 --no-check", "r");
  const std::string before = content_of(at("r/positions.npy"));
  interrupted(long_run, SIGKILL);
  EXPECT_TRUE(content_of(at("r/positions.npy")) == before);
  EXPECT_EQ(read_json(at("r/manifest.json"))["step_hashes"].size(), 2u);
}

TEST_F(CliEnding, TwoRunsDoNotWriteIntoOneFolder) {
  around.terminal = true;
  Program first(words_of(long_run), around);
  ASSERT_TRUE(first.wait_for("step 1 of"));
  around.terminal = false;
  expect_refused(hopmesh(long_run), "another run is writing into this folder");
}

TEST_F(CliEnding, OutThatCannotBeWrittenIsRefusedBeforeTheRun) {
  write_text(at("file"), "mine");
  expect_refused(hopmesh("run two-nodes --out file"), "file: ");
  expect_refused(hopmesh("run two-nodes --out file/deeper"), "file/deeper: ");
  EXPECT_EQ(content_of(at("file")), "mine");
  expect_refused(hopmesh("run two-nodes --out /proc/hopmesh"), "/proc/hopmesh: ");
  expect_refused(hopmesh("network two-nodes --step 0 --out /proc/hopmesh"), "/proc/hopmesh: ");
  expect_refused(hopmesh("solvers two-nodes --step 1 --out /proc/hopmesh"), "/proc/hopmesh: ");
  if (geteuid() == 0) return; // root may write everywhere else
  fs::create_directory(at("locked"));
  fs::permissions(at("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  expect_refused(hopmesh("run two-nodes --out locked"), "locked: ");
}

TEST_F(CliEnding, ADiskThatIsTooSmallIsRefusedBeforeTheRun) {
  fs::create_directory(at("disk"));
  if (mount("tmpfs", at("disk").c_str(), "tmpfs", 0, "size=256k") != 0)
    GTEST_SKIP() << "no right to mount a small disk";
  const Finished f = hopmesh("run two-nodes --out disk/r");
  const bool empty = !fs::exists(at("disk/r")) || names_in(at("disk/r")).empty();
  umount(at("disk").c_str());
  expect_refused(f, "are needed");
  EXPECT_TRUE(empty);
}

TEST_F(CliEnding, AWaveEndsEarlyAndSaysSoWhenItsDiskIsNearlyFull) {
  fs::create_directory(at("disk"));
  if (mount("tmpfs", at("disk").c_str(), "tmpfs", 0, "size=65m") != 0)
    GTEST_SKIP() << "no right to mount a small disk";
  const Finished f = hopmesh("run flag-225 --level systemc --steps 2 --no-check --out r --wave disk/w.vcd");
  const std::string wave = content_of(at("disk/w.vcd"));
  umount(at("disk").c_str());
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, ::testing::HasSubstr("disk/w.vcd: the wave ends early"));
  EXPECT_THAT(wave, ::testing::HasSubstr("$enddefinitions"));
  EXPECT_EQ(wave.back(), '\n');
  EXPECT_EQ(read_array(at("r/positions.npy")).shape[0], 3u); // the run itself is whole
}

TEST_F(CliEnding, AFileThatCannotGrowLeavesNoHalfOfIt) {
  around.largest_file = 200'000; // the report is larger, all else is not
  expect_refused(hopmesh("run two-nodes --steps 3 --out r"), "report.html: ");
  EXPECT_EQ(names_in(at("r")),
            (std::vector<std::string>{"manifest.json", "mesh.glb", "outputs_raw.npy", "picture.svg",
                                      "positions.npy", "stats.json", "steps.csv"}));
  EXPECT_EQ(read_array(at("r/positions.npy")).shape[0], 4u);
  around.largest_file = 4'000; // not even the positions
  expect_refused(hopmesh("run flag-225 --steps 2 --no-check --out q"), "positions.npy: ");
  EXPECT_TRUE(names_in(at("q")).empty());
  expect_refused(hopmesh("network flag-225 --step 0 --out n"), "W.mtx: ");
  EXPECT_TRUE(names_in(at("n")).empty());
}

TEST_F(CliEnding, ABarIsDrawnOnATerminalOnly) {
  const std::string line = "run flag-400 --no-check --steps 3 --out r";
  const Finished silent = hopmesh(line);
  EXPECT_EQ(silent.err, "");
  around.terminal = true;
  const Finished shown = hopmesh(line);
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_THAT(shown.err, HasSubstr("[====="));
  EXPECT_THAT(shown.err, HasSubstr("step 3 of 3, "));
  EXPECT_THAT(shown.err, HasSubstr(" s left"));
  const std::string wiped = "\r\033[K";
  ASSERT_GE(shown.err.size(), wiped.size());
  EXPECT_EQ(shown.err.substr(shown.err.size() - wiped.size()), wiped); // nothing stays on the line
  EXPECT_EQ(shown.out.find('\r'), std::string::npos);
}

TEST_F(CliEnding, ErrorsAreOneLineOnATerminalToo) {
  around.terminal = true;
  EXPECT_EQ(lines_of(hopmesh("run two-nodse").err).size(), 1u);
}

} // namespace
} // namespace hopmesh::tests
