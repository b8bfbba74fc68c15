// The wave of the engine is that of the SystemC array: the same signals, and every value of each at every
// time.
#include "tests/levels/wave_file.h"

namespace hopmesh::tests {
namespace {

class WaveOfLevels : public WaveFile {};

void expect_same(const Vcd& engine, const Vcd& systemc) {
  EXPECT_EQ(engine.times, systemc.times);
  ASSERT_EQ(engine.signals.size(), systemc.signals.size());
  std::size_t changes = 0;
  for (const auto& [name, wanted] : systemc.signals) {
    ASSERT_EQ(engine.signals.count(name), 1u) << name;
    const Vcd::Signal& found = engine.signals.at(name);
    EXPECT_EQ(found.width, wanted.width) << name;
    EXPECT_EQ(found.initial, wanted.initial) << name;
    ASSERT_EQ(found.changes.size(), wanted.changes.size()) << name;
    for (std::size_t k = 0; k < wanted.changes.size(); ++k) {
      ASSERT_EQ(found.changes[k].picoseconds, wanted.changes[k].picoseconds) << name << " change " << k;
      ASSERT_EQ(found.changes[k].value, wanted.changes[k].value) << name << " change " << k;
    }
    changes += wanted.changes.size();
  }
  EXPECT_GE(changes, 2u); // a window of one cycle: an edge, the next beat
}

/// GetParam() holds arguments here, not a level.
TEST_P(WaveOfLevels, IsTheSameWave) {
  const std::string arguments = nine + " --steps 3 " + GetParam();
  const Vcd systemc = wave(arguments, "systemc");
  const auto hash = column("hash");
  const Vcd engine = wave(arguments, "engine");
  EXPECT_EQ(column("hash"), hash);
  expect_same(engine, systemc);
}

INSTANTIATE_TEST_SUITE_P(Steps, WaveOfLevels,
                         testing::Values("", "--wave-window 0:1", "--wave-window 1:2",
                                         "--wave-window 2:", "--wave-window 1:99 --wave-cells 0,3-4"));
INSTANTIATE_TEST_SUITE_P(Cycles, WaveOfLevels,
                         testing::Values("--wave-window 0:1c", "--wave-window 17:40c", "--wave-window 97:98c",
                                         "--wave-window 100:400c", "--wave-window 30:100000c",
                                         "--wave-window 211:500c --wave-cells 7"));
INSTANTIATE_TEST_SUITE_P(Clocks, WaveOfLevels,
                         testing::Values("--set array.clock_mhz=3 --wave-window 100:400c",
                                         "--set array.clock_mhz=333", "--set array.clock_mhz=0.001"));
INSTANTIATE_TEST_SUITE_P(
    Folds, WaveOfLevels,
    testing::Values("--array folded --wave-window 1:2",
                    "--array folded --wave-window 100:900c --wave-cells 3",
                    "--set array.elements=2 --set array.schedule=synchronous --set array.pipeline=3",
                    "--array descent --set array.elements=4 --set array.stages=one --set array.pipeline=4 "
                    "--wave-window 200:700c",
                    "--set array.output=binary --set array.elements=3 --set array.lanes=9",
                    "--array prescaled --set array.pipeline=3 --wave-window 1:2"));
INSTANTIATE_TEST_SUITE_P(
    Stages, WaveOfLevels,
    testing::Values(
        "--set array.output=projected --set relax.stop=sum --wave-window 1:2",
        "--set array.output=projected --set array.normaliser=divider --set array.pipeline=2 --set "
        "array.elements=3 --wave-window 100:900c",
        "--set array.output=momentum --set array.schedule=synchronous",
        "--set array.output=momentum --set array.schedule=synchronous --set relax.stop=sum --set "
        "relax.momentum=[1] --set array.pipeline=3 --wave-window 100:900c",
        "--array descent --set array.output=momentum --set array.schedule=synchronous --set "
        "array.elements=4 --set array.stages=one --set array.pipeline=2 --set relax.momentum=[0.9,1]",
        "--set array.output=momentum --set array.schedule=synchronous --set array.elements=5 --set "
        "relax.momentum=[1] --wave-window 30:700c --wave-cells 0,3-4"));
INSTANTIATE_TEST_SUITE_P(Arrays, WaveOfLevels,
                         testing::Values("--array descent --wave-window 300:900c", "--array prescaled",
                                         "--array byte --wave-window 1:2",
                                         "--set array.schedule=sequential --set array.lanes=4",
                                         "--set array.schedule=synchronous --set array.bus_bits=128"));

/// A window that begins at any cycle around the ends of segments and runs.
class AnyWave : public WaveFile {};

TEST_P(AnyWave, MayBeginAndEndAtAnyCycle) {
  good(line(nine + " --steps 2 --no-check --out r"));
  const std::uint64_t one = cycles().at(0);
  for (const std::uint64_t first :
       {std::uint64_t{1}, std::uint64_t{46}, std::uint64_t{47}, one - 1, one, one + 1})
    for (const std::uint64_t length : {1u, 2u, 31u}) {
      const std::string window =
          " --wave-window " + std::to_string(first) + ":" + std::to_string(first + length) + "c";
      SCOPED_TRACE(window);
      const Vcd systemc = wave(nine + " --steps 2" + window, "systemc");
      expect_same(wave(nine + " --steps 2" + window, "engine"), systemc);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, AnyWave, testing::Values("engine"));

/// A file that may not grow further is like a disk that is full: the run goes on, the wave is told and gone.
/// All other files of the run are smaller than that, and the wave is larger (10 MB).
TEST_P(AnyWave, ThatCannotBeWrittenIsToldAndChangesNoBit) {
  const std::string arguments = nine + " --set relax.max_sweeps=30 --steps 20 --no-check --out r";
  good(line(arguments));
  const auto hash = column("hash");
  around.largest_file = 2'000'000;
  const Finished f = run(arguments + " --wave w.vcd");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_EQ(column("hash"), hash);
  EXPECT_EQ(f.err, "hopmesh: w.vcd: cannot write: File too large\n");
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{"r"});
}

} // namespace
} // namespace hopmesh::tests
