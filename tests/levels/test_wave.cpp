// --wave of the built program: every register of the model, the cells asked for, the bits of the run, whole
// or absent, and one line for a bad window.
#include "tests/levels/wave_file.h"

#include "place.h"

#include <algorithm>
#include <csignal>
#include <thread>

namespace hopmesh::tests {
namespace {

TEST_P(WaveFile, ShowsEveryRegisterOfTheModelOnce) {
  const Vcd vcd = wave(nine + " --steps 1");
  for (std::size_t cell = 0; cell < 8; ++cell)
    for (std::size_t p = 0; p < 3; ++p) {
      for (const char* name :
           {".accumulator.s", ".accumulator.norm", ".output.u", ".output.delta", ".output.V"})
        EXPECT_NO_THROW(vcd.at(neuron(cell, p) + name));
    }
  for (const char* name : {"clock", "segment", "beat", "busy", "sweeps"})
    EXPECT_NO_THROW(vcd.at(std::string(".sequencer.") + name));
  EXPECT_NO_THROW(vcd.at(".device.irq"));
  EXPECT_EQ(vcd.signals.size(), 8u * 3 * 5 + 6);
}

TEST_P(WaveFile, OfSomeCellsHoldsOnlyThose) {
  const Vcd vcd = wave(nine + " --steps 1 --wave-cells 1,5-6,5");
  EXPECT_EQ(vcd.signals.size(), 3u * 3 * 5 + 6);
  for (std::size_t cell : {1u, 5u, 6u}) EXPECT_NO_THROW(vcd.at(neuron(cell, 0) + ".output.V"));
}

TEST_P(WaveFile, EndsWithTheOutputsOfTheRun) {
  const Vcd vcd = wave(nine + " --steps 3");
  const auto codes = last_codes(9 * 3); // node 0 is pinned
  std::size_t moved = 0;
  for (std::size_t k = 0; k < 8 * 3; ++k) {
    const Vcd::Signal& v = vcd.at(neuron(k / 3, k % 3) + ".output.V");
    EXPECT_EQ(v.last(), codes[3 + k]) << "neuron " << k;
    moved += v.changes.size() > 1;
  }
  EXPECT_GT(moved, 8u);
}

TEST_P(WaveFile, ChangesNoBitOfTheRun) {
  wave(nine + " --steps 4");
  const auto with = column("hash");
  const auto with_cycles = cycles();
  ASSERT_EQ(with.size(), 4u);
  ASSERT_EQ(run(nine + " --steps 4 --no-check --out r"), 0);
  EXPECT_EQ(column("hash"), with);
  EXPECT_EQ(cycles(), with_cycles);
}

TEST_P(WaveFile, IsNotLeftBehindHalfWritten) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.c_str()) != 0) _exit(1);
    std::freopen("/dev/null", "w", stdout);
    execl(HOPMESH_PROGRAM, "hopmesh", "run", "flag-400", "--no-check", "--out", "r", "--wave", "w.vcd",
          "--level", GetParam().c_str(), nullptr);
    _exit(1);
  }
  const auto growing = [&] {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().rfind("w.vcd.", 0) == 0 && entry.file_size() > 100000) return true;
    return false;
  };
  for (int k = 0; k < 2000 && !growing(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(growing());
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::exists(folder / "w.vcd"));
}

TEST_P(WaveFile, RefusesBadWindowsAndCellsInOneLine) {
  std::size_t refused = 0;
  for (const char* bad :
       {"--wave-window 5:5", "--wave-window 7:3", "--wave-window 3", "--wave-window a:b",
        "--wave-window 1:2x", "--wave-window=-1:3", "--wave-window 1:2cc", "--wave-window 1c:2c",
        "--wave-window 1:1234567890123456789", "--wave-window '1 :2'", "--wave-cells 8", "--wave-cells 0-8",
        "--wave-cells ,", "--wave-cells 1,", "--wave-cells 1-2-3", "--wave-cells a", "--wave-cells=-1",
        "--wave-cells 0x1"}) {
    EXPECT_EQ(run(nine + " --steps 1 --out r --wave w.vcd " + bad), 2) << bad;
    const std::string told = content(folder / "err.txt");
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << bad << ": " << told;
    EXPECT_EQ(content(folder / "out.txt"), "") << bad;
    EXPECT_FALSE(fs::exists(folder / "w.vcd") || fs::exists(folder / "r")) << bad;
    ++refused;
  }
  EXPECT_EQ(refused, 18u);
}

INSTANTIATE_TEST_SUITE_P(At, WaveFile, testing::Values("systemc", "engine"),
                         [](const auto& level) { return level.param; });

} // namespace
} // namespace hopmesh::tests
