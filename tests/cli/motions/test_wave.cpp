// --wave: a VCD of the window and the cells that were asked for, and the same bits as without.
#include "tests/support/cli_test.h"

#include <set>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

// Six nodes in a row, 0 and 3 pinned: four cells.
const std::string six_nodes =
    "two-nodes --level systemc --set mesh.grid.columns=6 --set mesh.pinned=[0,3] --set "
    "force.wind=[0.3,0.1,0] --steps 3 --no-check "
    "--set relax.max_sweeps=12";

class CliWave : public Cli {
 protected:
  struct Vcd {
    std::set<std::string> scopes;
    double first = -1, last = -1; ///< times, ns
    std::size_t lines = 0;
  };
  Vcd read_vcd(const std::string& name) const {
    Vcd vcd;
    bool header = false;
    for (const std::string& line : lines_of(content_of(at(name)))) {
      vcd.lines += 1;
      if (line.rfind("$scope module ", 0) == 0) vcd.scopes.insert(split(line, ' ')[2]);
      header = header || line.rfind("$enddefinitions", 0) == 0;
      if (line[0] != '#') continue;
      vcd.last = std::stod(line.substr(1));
      if (vcd.first < 0) vcd.first = vcd.last;
    }
    EXPECT_TRUE(header) << name;
    return vcd;
  }
};

TEST_F(CliWave, ChangesNoBitAndLeavesOneFile) {
  results_of(six_nodes, "without");
  results_of(six_nodes + " --wave w.vcd", "with");
  expect_same_bits(at("without"), at("with"));
  EXPECT_EQ(names_in(around.folder), (std::vector<std::string>{"w.vcd", "with", "without"}));
  const Vcd vcd = read_vcd("w.vcd");
  for (const char* scope : {"cell_0", "cell_3", "neuron_0", "neuron_2", "accumulator", "output", "sequencer"})
    EXPECT_EQ(vcd.scopes.count(scope), 1u) << scope;
}

TEST_F(CliWave, KeepsToTheCellsAskedFor) {
  results_of(six_nodes + " --wave w.vcd --wave-cells 1-2 --wave-window 0:1", "r");
  const Vcd vcd = read_vcd("w.vcd");
  EXPECT_EQ(vcd.scopes.count("cell_0") + vcd.scopes.count("cell_3"), 0u);
  EXPECT_EQ(vcd.scopes.count("cell_1") + vcd.scopes.count("cell_2"), 2u);
}

TEST_F(CliWave, WindowOfStepsHoldsThatStepsCycles) {
  const auto cycles =
      read_table(results_of(six_nodes + " --wave w.vcd --wave-window 1:2 --wave-cells 0", "r") / "steps.csv")
          .numbers("cycles");
  const Vcd vcd = read_vcd("w.vcd");
  const double clock = 10; // ns, 100 MHz
  EXPECT_GE(vcd.first, clock * cycles[0]);
  EXPECT_GE(vcd.last - vcd.first, clock * (cycles[1] - 2));
  EXPECT_LE(vcd.last - vcd.first, clock * (cycles[1] + 1000)); // and the bus
}

TEST_F(CliWave, WindowOfCyclesIsThatLong) {
  results_of(six_nodes + " --wave w.vcd --wave-window 100:200c --wave-cells 0", "r");
  const Vcd vcd = read_vcd("w.vcd");
  EXPECT_LE(vcd.last - vcd.first, 1000);
  EXPECT_GE(vcd.last - vcd.first, 900);
}

TEST_F(CliWave, OpenEndsReachToTheEnds) {
  results_of(six_nodes + " --wave all.vcd --wave-cells 0", "a");
  results_of(six_nodes + " --wave early.vcd --wave-window :1 --wave-cells 0", "b");
  results_of(six_nodes + " --wave late.vcd --wave-window 2: --wave-cells 0", "c");
  const Vcd all = read_vcd("all.vcd"), early = read_vcd("early.vcd"), late = read_vcd("late.vcd");
  EXPECT_EQ(early.first, all.first);
  EXPECT_LT(early.last, late.first);
  EXPECT_NEAR(late.last, all.last, 10);
}

TEST_F(CliWave, AtLevelSystemcClockIsTheSameWave) {
  results_of(six_nodes + " --wave a.vcd --wave-window 0:1", "a");
  std::string by_clock = six_nodes;
  by_clock.replace(by_clock.find("systemc"), 7, "systemc-clock");
  results_of(by_clock + " --wave b.vcd --wave-window 0:1", "b");
  const Vcd a = read_vcd("a.vcd"), b = read_vcd("b.vcd");
  EXPECT_EQ(a.scopes, b.scopes);
  EXPECT_EQ(a.last, b.last);
}

TEST_F(CliWave, OfTheSmallestMeshGoesIntoNewFolders) {
  good("run two-nodes --level systemc --steps 1 --out r --wave 'deep/er waves/w.vcd'");
  EXPECT_GT(read_vcd("deep/er waves/w.vcd").lines, 20u);
}

TEST_F(CliWave, AWindowThatNeverComesIsTold) {
  const Finished f = hopmesh("run two-nodes --level systemc --out r --wave w.vcd --wave-window 50:60");
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_EQ(f.err, "hopmesh: w.vcd: no wave, the run ended before the window began\n");
  EXPECT_FALSE(std::filesystem::exists(at("w.vcd")));
}

TEST_F(CliWave, AFolderThatCannotBeMadeIsRefusedBeforeTheRun) {
  const Finished f = hopmesh("run two-nodes --level systemc --out r --wave /proc/none/w.vcd");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_EQ(lines_of(f.err).size(), 1u) << f.err;
  EXPECT_FALSE(std::filesystem::exists(at("r")));
}

} // namespace
} // namespace hopmesh::tests
