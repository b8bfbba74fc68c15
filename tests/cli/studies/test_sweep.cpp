// hopmesh sweep, chart, stability: rows in order, kills, changed studies, points that diverge.
#include "tests/support/cli_test.h"

#include <chrono>
#include <csignal>
#include <thread>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliSweep : public Cli {
 protected:
  const std::string study = "scene = \"two-nodes\"\nsteps = 10\nmethods = [\"reference\", \"engine\"]\n"
                            "times = [0.1]\n[axes]\n\"motion.time_step\" = [0.02, 0.05]\n"
                            "\"array.lanes\" = [1, 2]\n";

  /// Rows without the one column that may differ: the seconds of this machine.
  std::vector<std::vector<std::string>> rows_of(const std::string& folder) const {
    std::vector<std::vector<std::string>> rows;
    std::size_t skip = 0;
    for (const std::string& line : lines_of(content_of(at(folder) / "results.csv"))) {
      auto cells = split(line, ',');
      for (std::size_t k = 0; rows.empty() && k < cells.size(); ++k)
        if (cells[k] == "host_seconds") skip = k;
      cells.at(skip) = "";
      rows.push_back(cells);
    }
    return rows;
  }
};

TEST_F(CliSweep, HasARowAPointInOrderWhateverTheWorkers) {
  write_text(at("s.toml"), study);
  good("sweep s.toml --out one -j 1");
  good("sweep s.toml --out two -j 3");
  const auto rows = rows_of("one");
  EXPECT_EQ(rows, rows_of("two"));
  ASSERT_EQ(rows.size(), 1u + 2 * 2 * 2);
  const std::vector<std::string> head(rows[0].begin(), rows[0].begin() + 15);
  EXPECT_EQ(head, (std::vector<std::string>{
                      "point", "motion.time_step", "array.lanes", "method", "status", "class", "output_error",
                      "output_error_median", "rounding_error", "rounding_error_median", "stopping_error",
                      "stopping_error_median", "position_error", "reference_error@0.1", "truth_error@0.1"}));
  EXPECT_EQ(std::vector<std::string>(rows[6].begin(), rows[6].begin() + 5),
            (std::vector<std::string>{"5", "0.02", "2", "engine", "finished"}));
  EXPECT_EQ(rows[1][12], "0") << "the reference against itself";
  EXPECT_GT(std::stod(rows[6][12]), 0);
}

TEST_F(CliSweep, TwoAxesMeetInOneKey) {
  write_text(at("s.toml"),
             "scene = \"two-nodes\"\nsteps = 3\n[axes.rounding]\nlabel = [\"SC_TRN\", \"SC_RND\"]\n"
             "[axes.width]\nlabel = [8, 12]\n\"formats.state\" = \"fixed<{},2,{rounding},SC_SAT>\"\n"
             "\"formats.link\" = \"fixed<{},2,{rounding},SC_SAT>\"\n");
  good("sweep s.toml --out r");
  const auto commands = read_table(at("r") / "results.csv").column.at("command");
  ASSERT_EQ(commands.size(), 4u);
  EXPECT_THAT(commands[1], HasSubstr("formats.state=fixed<12,2,SC_TRN,SC_SAT>"));
  EXPECT_THAT(commands[2], HasSubstr("formats.link=fixed<8,2,SC_RND,SC_SAT>"));
  write_text(at("t.toml"), "scene = \"two-nodes\"\n[axes.width]\nlabel = [8]\n"
                           "\"formats.state\" = \"fixed<{},2,{rouning},SC_SAT>\"\n");
  const Finished f = hopmesh("sweep t.toml --out t");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("t.toml:4: formats.state"));
}

TEST_F(CliSweep, TheCommandOfARowRepeatsIt) {
  write_text(at("s.toml"), study);
  good("sweep s.toml --out r");
  const Table rows = read_table(at("r") / "results.csv");
  const std::size_t row = 5;
  const std::string command = rows.column.at("command").at(row);
  ASSERT_EQ(command.rfind("hopmesh run ", 0), 0u);
  good(command.substr(8) + " --out again");
  double sweeps = 0;
  for (double s : read_table(at("again") / "steps.csv").numbers("sweeps")) sweeps += s;
  EXPECT_GT(sweeps, 0);
  EXPECT_EQ(rows.numbers("sweeps").at(row), sweeps);
}

TEST_F(CliSweep, ADivergingPointIsARowAndStopsNobody) {
  write_text(at("s.toml"), "scene = \"two-nodes\"\nsteps = 40\n[axes]\n\"probe.gamma\" = [1e9, 10.0]\n");
  good("sweep s.toml --out r");
  const auto rows = rows_of("r");
  EXPECT_EQ(rows.at(1).at(3), "diverged");
  EXPECT_EQ(rows.at(1).at(4), "blow-up");
  EXPECT_EQ(rows.at(2).at(3), "finished");
  good("chart r");
  EXPECT_THAT(content_of(at("r") / "chart.svg"), HasSubstr("class=\"point failed\""));
}

TEST_F(CliSweep, GoesOnAfterKillsAndInterrupts) {
  write_text(at("s.toml"), "scene = \"flag-225\"\nsteps = 12\n[axes]\n\"relax.threshold\" = [1e-3, 1e-4]\n"
                           "\"motion.time_step\" = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06]\n");
  good("sweep s.toml --out unbroken");
  std::size_t broken = 0;
  for (const int signal : {SIGKILL, SIGINT, SIGKILL}) {
    Program program(words_of("sweep s.toml --out r -j 2"), around);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    program.send(signal);
    const Finished f = program.finish();
    EXPECT_TRUE(f.signal == SIGKILL || f.exit_code == 130 || f.exit_code == 0) << f.exit_code << f.err;
    broken += f.exit_code != 0;
  }
  EXPECT_GT(broken, 0u) << "nothing was broken off: is the test blind?";
  good("sweep s.toml --out r -j 2");
  EXPECT_EQ(rows_of("r"), rows_of("unbroken"));
}

TEST_F(CliSweep, SharesTogetherAreTheWhole) {
  write_text(at("s.toml"), study);
  EXPECT_THAT(good("sweep s.toml --out r --share 0/2").out, HasSubstr("4 of 8 points"));
  EXPECT_FALSE(std::filesystem::exists(at("r") / "results.csv"));
  good("sweep s.toml --out r --share 1/2");
  good("sweep s.toml --out r");
  good("sweep s.toml --out whole");
  EXPECT_EQ(rows_of("r").size(), rows_of("whole").size());
}

TEST_F(CliSweep, AChangedStudyIsRefused) {
  write_text(at("s.toml"), study);
  good("sweep s.toml --out r");
  write_text(at("s.toml"), study + "\"relax.threshold\" = [1e-3]\n");
  const Finished f = hopmesh("sweep s.toml --out r");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("before a change"));
}

TEST_F(CliSweep, MistakesAreToldByLineBeforeAnythingRuns) {
  const auto mistake = [this](const std::string& more, const std::string& words) {
    write_text(at("s.toml"), "scene = \"two-nodes\"\nsteps = 10\n" + more);
    refused("sweep s.toml --out r", words);
    EXPECT_FALSE(std::filesystem::exists(at("r"))) << more;
  };
  mistake("[axes]\n\"probe.gmma\" = [1, 2]\n", "s.toml:4: probe.gmma: found an unknown key");
  mistake("[axes]\n\"probe.gamma\" = []\n", "s.toml:4: ");
  mistake("[axes]\n\"array.lanes\" = [1, 0]\n", "s.toml:4: array.lanes: found 0");
  mistake("times = [0.2, 0.2]\n", "s.toml:3: times: found 0.2, expected each time after the one before");
  mistake("times = [100]\n", "s.toml:3: times: found 100");
  mistake("methods = [\"engin\"]\n", "mean engine?");
}

// Two methods are implicit Euler, one by the array: next to each other, and off the truth by what the step
// costs.
TEST_F(CliSweep, RivalsAndTheTruthStandBesideTheArray) {
  write_text(at("s.toml"),
             "scene = \"banner\"\nmethods = [\"engine\", \"backward_euler\", \"velocity_verlet\"]\n"
             "times = [0.1]\n[axes]\n\"mesh.grid.rows\" = [6]\n"
             "[axes.step]\nlabel = [\"2 ms\", \"1 ms\"]\n"
             "\"motion.time_step\" = [0.002, 0.001]\n\"motion.steps\" = [50, 100]\n");
  good("sweep s.toml --out r");
  const Table t = read_table(at("r") / "results.csv");
  const std::vector<double> error = t.numbers("truth_error@0.1");
  ASSERT_EQ(error.size(), 6u);
  EXPECT_NEAR(error[0], error[2], 0.1 * error[2]); // 2 ms
  EXPECT_NEAR(error[1], error[3], 0.1 * error[3]); // 1 ms
  EXPECT_NEAR(error[2] / error[3], 2, 0.3);        // order 1
  EXPECT_LT(error[4], 0.1 * error[2]);             // Verlet at 2 ms
  for (double floor : t.numbers("truth_floor@0.1")) {
    EXPECT_GT(floor, 0);
    EXPECT_LT(floor, 1e-8);
  }
  good("chart r");
  EXPECT_THAT(content_of(at("r") / "chart.svg"), HasSubstr("truth floor"));
  std::size_t truths = 0;
  for (const std::string& name : names_in(at("r")))
    truths += name.rfind("truth-", 0) == 0 && name.find(".npy") != std::string::npos;
  EXPECT_EQ(truths, 1u) << "one physics, one truth";
}

TEST_F(CliSweep, AMapHasAClassACellAndItsPredictedLines) {
  good("stability first-map --out m");
  EXPECT_EQ(lines_of(content_of(at("m") / "stability.csv")).size(), 1u + 4 * 3 * 2);
  const std::string svg = content_of(at("m") / "stability.svg");
  for (const char* words : {"engine, memoryless", "engine, literal", "dt omega = 2.83", "blow-up"})
    EXPECT_THAT(svg, HasSubstr(words));
  write_text(at("s.toml"), "scene = \"two-nodes\"\n[axes]\n\"probe.gamma\" = [1, 2]\n");
  EXPECT_THAT(hopmesh("stability s.toml").err, HasSubstr("s.toml:3: axes: found 1 axes of numbers"));
}

} // namespace
} // namespace hopmesh::tests
