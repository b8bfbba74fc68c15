// hopmesh run --wave: where the file goes, and what is said where none can come. What a wave shows:
// tests/levels.
#include "tests/support/cli_test.h"
#include "tests/support/vcd.h"

namespace hopmesh::tests {
namespace {

class CliWave : public Cli {};

TEST_F(CliWave, AtLevelSystemcClockIsTheWaveOfLevelSystemc) {
  const std::string run =
      "run two-nodes --set mesh.grid.columns=6 --set force.wind=[0.3,0.1,0] --steps 3 --no-check "
      "--set relax.max_sweeps=12 --wave-window 0:1 --level ";
  good(run + "systemc --out a --wave a.vcd");
  good(run + "systemc-clock --out b --wave b.vcd");
  EXPECT_EQ(names_in(around.folder), (std::vector<std::string>{"a", "a.vcd", "b", "b.vcd"}));
  const Vcd a = read_vcd(at("a.vcd")), b = read_vcd(at("b.vcd"));
  EXPECT_EQ(a.times, b.times);
  ASSERT_EQ(a.signals.size(), b.signals.size());
  for (const auto& [name, signal] : a.signals) {
    EXPECT_EQ(b.at(name).changes.size(), signal.changes.size()) << name;
    EXPECT_EQ(b.at(name).last(), signal.last()) << name;
  }
}

TEST_F(CliWave, OfTheSmallestMeshGoesIntoNewFolders) {
  good("run two-nodes --level systemc --steps 1 --out r --wave 'deep/er waves/w.vcd'");
  EXPECT_GT(read_vcd(at("deep/er waves/w.vcd")).times.size(), 20u);
}

TEST_F(CliWave, AWindowThatNeverComesIsTold) {
  const Finished f = hopmesh("run two-nodes --level systemc --out r --wave w.vcd --wave-window 50:60");
  EXPECT_EQ(f.exit_code, 0);
  EXPECT_EQ(f.err, "hopmesh: w.vcd: no wave, the run ended before the window began\n");
  EXPECT_FALSE(std::filesystem::exists(at("w.vcd")));
}

// Viewers would take them for what their names say.
TEST_F(CliWave, OtherFormatsAreRefused) {
  for (const char* file : {"w.fst", "w.FST", "deep/w.ghw", "w.lxt2", "w.fsdb"})
    for (const char* level : {"engine", "systemc", "systemc-clock"})
      refused(std::string("run two-nodes --out r --wave ") + file + " --level " + level,
              std::string("--wave: found ") + file + ", expected FILE.vcd");
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>());
}

TEST_F(CliWave, AFolderThatCannotBeMadeIsRefusedBeforeTheRun) {
  refused("run two-nodes --level systemc --out r --wave /proc/none/w.vcd");
  EXPECT_FALSE(std::filesystem::exists(at("r")));
}

} // namespace
} // namespace hopmesh::tests
