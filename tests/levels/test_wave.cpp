// --wave of the built program: every register of the model, the cells asked for, the bits of the run, whole
// or absent, and one line for a bad window.
#include "tests/levels/wave_file.h"

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
  const auto codes =
      read_array(at("r/outputs_raw.npy")).values; // of nine nodes a step, of which node 0 is pinned
  const auto* last = codes.data() + codes.size() - 9 * 3;
  std::size_t moved = 0;
  for (std::size_t k = 0; k < 8 * 3; ++k) {
    const Vcd::Signal& v = vcd.at(neuron(k / 3, k % 3) + ".output.V");
    EXPECT_EQ(v.last(), last[3 + k]) << "neuron " << k;
    moved += v.changes.size() > 1;
  }
  EXPECT_GT(moved, 8u);
}

TEST_P(WaveFile, ChangesNoBitOfTheRun) {
  wave(nine + " --steps 4");
  const auto with = column("hash");
  const auto with_cycles = cycles();
  ASSERT_EQ(with.size(), 4u);
  good(line(nine + " --steps 4 --no-check --out r"));
  EXPECT_EQ(column("hash"), with);
  EXPECT_EQ(cycles(), with_cycles);
}

TEST_P(WaveFile, IsNotLeftBehindHalfWritten) {
  Program program(words_of(line("flag-400 --no-check --out r --wave w.vcd")), around);
  const auto growing = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(around.folder))
      if (entry.path().filename().string().rfind("w.vcd.", 0) == 0 && entry.file_size() > 100000) return true;
    return false;
  };
  for (int k = 0; k < 2000 && !growing(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(growing());
  program.send(SIGKILL);
  EXPECT_EQ(program.finish().signal, SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(at("w.vcd")));
}

TEST_P(WaveFile, RefusesBadWindowsAndCellsInOneLine) {
  std::size_t count = 0;
  for (const char* bad :
       {"--wave-window 5:5", "--wave-window 7:3", "--wave-window 3", "--wave-window a:b",
        "--wave-window 1:2x", "--wave-window=-1:3", "--wave-window 1:2cc", "--wave-window 1c:2c",
        "--wave-window 1:1234567890123456789", "--wave-window '1 :2'", "--wave-cells 8", "--wave-cells 0-8",
        "--wave-cells ,", "--wave-cells 1,", "--wave-cells 1-2-3", "--wave-cells a", "--wave-cells=-1",
        "--wave-cells 0x1"}) {
    refused(line(nine + " --steps 1 --out r --wave w.vcd " + bad));
    EXPECT_EQ(names_in(around.folder), std::vector<std::string>{}) << bad;
    ++count;
  }
  EXPECT_EQ(count, 18u);
}

INSTANTIATE_TEST_SUITE_P(At, WaveFile, testing::Values("systemc", "engine"),
                         [](const auto& level) { return level.param; });

} // namespace
} // namespace hopmesh::tests
