// hopmesh size: the array it leaves meets the error, one less of each knob does not, kills lose nothing.
#include "tests/support/cli_test.h"

#include <cmath>
#include <csignal>
#include <thread>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliSize : public Cli {
 protected:
  const std::string small = "banner --set mesh.grid.rows=4 --set mesh.grid.columns=5";
  const std::string net = small + " --steps 10";

  /// Positions at the end of a run.
  std::vector<double> end_of(const std::string& line) const {
    std::filesystem::remove_all(at("run"));
    const Finished f = hopmesh("run " + line + " --out run"); // may say that an array has no fast kernel
    EXPECT_EQ(f.exit_code, 0) << line << f.err;
    const Array all = read_array(at("run") / "positions.npy");
    const auto size = static_cast<std::ptrdiff_t>(all.shape[1] * 3);
    return {all.values.end() - size, all.values.end()};
  }

  double distance(const std::string& line, const std::vector<double>& target) const {
    const std::vector<double> end = end_of(line);
    double sum = 0;
    for (std::size_t k = 0; k < end.size(); ++k) sum += (end[k] - target[k]) * (end[k] - target[k]);
    return std::sqrt(sum / (static_cast<double>(end.size()) / 3));
  }

  static std::string run_of(const std::string& command) {
    return command.substr(std::string("hopmesh run ").size());
  }

  /// Of the run that end_of() or distance() made last.
  double sweeps() const {
    double all = 0;
    for (double s : read_table(at("run") / "steps.csv").numbers("sweeps")) all += s;
    return all;
  }

  /// Reruns every row of the evidence: the error it tells is the error it has, and each verdict holds.
  void expect_evidence(const std::string& folder, double error, const std::string& reference) {
    const auto target = end_of(reference);
    const double most_sweeps = 1.1 * sweeps();
    const Table t = read_table(at(folder) / "size.csv");
    const double files_sweeps = t.numbers("sweeps").at(1);
    EXPECT_LE(t.numbers("sweeps").at(0), files_sweeps);
    std::size_t less = 0;
    for (std::size_t k = 0; k < t.rows(); ++k) {
      const std::string &what = t.column.at("what")[k], &command = t.column.at("command")[k],
                        &fails_by = t.column.at("fails_by")[k];
      const double again = distance(run_of(command), target);
      EXPECT_NEAR(again, t.numbers("error")[k], 1e-12) << command;
      EXPECT_EQ(again > error, fails_by == "error") << command;
      const bool relaxation = t.column.at("knob")[k].rfind("relax.", 0) == 0;
      if (fails_by == "sweeps") {
        EXPECT_GT(sweeps(), relaxation ? files_sweeps : most_sweeps) << command;
      }
      const bool evidence = what == "one less" || what == "two less";
      less += evidence;
      if (what != "lanes") {
        EXPECT_EQ(fails_by.empty(), !evidence) << command;
      }
    }
    EXPECT_GE(less, 6u);
  }
};

TEST_F(CliSize, TheArrayMeetsTheErrorAndOneLessDoesNot) {
  const Finished f = good("size " + net + " --error 1e-4 --out s");
  const auto target = end_of(net + " --level reference");
  EXPECT_LE(distance(net + " --array s/size.toml", target), 1e-4);
  expect_evidence("s", 1e-4, net + " --level reference");
  EXPECT_THAT(f.out, HasSubstr("Formats tried: "));
  EXPECT_THAT(f.out, HasSubstr(", 0 of them with less silicon than this"));
}

// The probe, and an array without a reciprocal that starts from another preset.
TEST_F(CliSize, SizesAProbeOnAnArrayOfOnesOwn) {
  good("size two-nodes --steps 20 --array descent --error 1e-4 --out s");
  const auto target = end_of("two-nodes --steps 20 --level reference");
  EXPECT_LE(distance("two-nodes --steps 20 --array s/size.toml", target), 1e-4);
  const std::string toml = content_of(at("s") / "size.toml");
  EXPECT_THAT(toml, HasSubstr("normaliser = \"divider\""));
  EXPECT_THAT(toml, HasSubstr("SC_TRN_ZERO"));
  expect_evidence("s", 1e-4, "two-nodes --steps 20 --level reference");
}

TEST_F(CliSize, WorkersChangeNothing) {
  good("size " + net + " --error 1e-3 --out one -j 1");
  good("size " + net + " --error 1e-3 --out two -j 3");
  for (const char* file : {"size.csv", "size.toml"})
    EXPECT_EQ(content_of(at("one") / file), content_of(at("two") / file));
}

TEST_F(CliSize, LanesMeetATimePerStep) {
  good("size " + net + " --error 1e-3 --out s");
  const Table knee = read_table(at("s") / "size.csv");
  std::vector<double> seconds, lanes;
  for (std::size_t k = 0; k < knee.rows(); ++k)
    if (knee.column.at("what")[k] == "lanes")
      seconds.push_back(knee.numbers("slowest_step")[k]), lanes.push_back(knee.numbers("array.lanes")[k]);
  ASSERT_GE(lanes.size(), 3u);
  // Between the times of the second and the third number of lanes: the third is the first to do.
  const double between = (seconds[1] + seconds[2]) / 2;
  good("size " + net + " --error 1e-3 --out s --time-per-step " + std::to_string(between));
  EXPECT_THAT(content_of(at("s") / "size.toml"),
              HasSubstr("lanes = " + std::to_string(static_cast<int>(lanes[2])) + "\n"));
  const Finished f = hopmesh("size " + net + " --error 1e-3 --out s --time-per-step 1e-9");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("no number of lanes does a step in 1e-09 s"));
}

TEST_F(CliSize, AgainstTheTruth) {
  const Finished near = hopmesh("size " + net + " --against truth --error 1e-6 --out s");
  EXPECT_EQ(near.exit_code, 1) << near.err;
  EXPECT_THAT(near.out, HasSubstr("1e-06 m is less than double itself reaches: the reference ends "));
  const Finished f = good("size " + net + " --against truth --error 0.1 --out t");
  EXPECT_THAT(f.out, HasSubstr("from the truth, which is known to "));
  const auto target = end_of(small + " --set motion.time_step=0.0001 --steps 1000 --level rk4");
  EXPECT_LE(distance(net + " --array t/size.toml", target), 0.1 + 1e-6);
}

TEST_F(CliSize, SaysWhenNoArrayReachesTheError) {
  const Finished f = hopmesh("size " + net + " --error 1e-14 --out s");
  EXPECT_EQ(f.exit_code, 1) << f.err;
  EXPECT_EQ(lines_of(f.out).size(), 1u) << f.out;
  EXPECT_THAT(f.out, HasSubstr("no array meets 1e-14 m: the nearest of "));
  EXPECT_FALSE(std::filesystem::exists(at("s") / "size.toml"));
}

TEST_F(CliSize, GoesOnAfterKills) {
  good("size " + net + " --error 1e-4 --out unbroken");
  std::size_t broken = 0;
  for (const int signal : {SIGKILL, SIGINT, SIGKILL}) {
    Program program(words_of("size " + net + " --error 1e-4 --out r -j 2"), around);
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    program.send(signal);
    const Finished f = program.finish();
    EXPECT_TRUE(f.signal == SIGKILL || f.signal == SIGINT || f.exit_code == 130 || f.exit_code == 0)
        << f.exit_code << f.err;
    broken += f.exit_code != 0;
  }
  EXPECT_GT(broken, 0u) << "nothing was broken off: is the test blind?";
  good("size " + net + " --error 1e-4 --out r");
  EXPECT_EQ(content_of(at("r") / "size.csv"), content_of(at("unbroken") / "size.csv"));
}

TEST_F(CliSize, RefusesInOneLine) {
  refused("size two-nodes", "--error");
  refused("size two-nodes --error 0", "found 0, expected a number above 0");
  refused("size two-nodes --error -1", "expected a number above 0");
  refused("size two-nodes --error nan", "expected a number above 0");
  refused("size two-node --error 1", "did you mean two-nodes?");
  refused("size two-nodes --error 1 --against thruth", "--against");
  refused("size two-nodes --error 1 --time-per-step 0", "found 0, expected a number above 0");
  refused("size two-nodes --error 1 --set 'formats.accumulator=fixed<40,12,SC_TRN,SC_SAT>'",
          "formats.accumulator: found fixed<40,12,SC_TRN,SC_SAT>, expected \"exact\"");
  EXPECT_FALSE(std::filesystem::exists(at("out")));
  good("size two-nodes --steps 5 --error 1e-2 --out s");
  refused("size two-nodes --steps 6 --error 1e-2 --out s", "trials of another scene, array or length");
}

} // namespace
} // namespace hopmesh::tests
