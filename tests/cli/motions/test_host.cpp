// Who runs the firmware: run --host, its keys, files and refusals.
#include "tests/support/cli_test.h"

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliHost : public Cli {
 protected:
  /// Compiler, library and emulator were there when the program was built; where not, a line says so.
  bool has_core() const {
    const Finished f = hopmesh("run two-nodes --steps 1 --host rv32 --out core");
    EXPECT_THAT(f.err, f.exit_code == 0 ? HasSubstr("") : HasSubstr("built without"));
    return f.exit_code == 0;
  }
};

TEST_F(CliHost, TheCoreLeavesTheFilesOfTheNativeHost) {
  if (!has_core()) GTEST_SKIP() << "built without compiler or emulator";
  good("run two-nodes --steps 6 --host native --out n");
  const Finished f = good("run two-nodes --steps 6 --host rv32 --set host.core=rv32imfd --out r");
  EXPECT_THAT(f.out, HasSubstr("of it the host's"));
  for (const char* file : {"positions.npy", "outputs_raw.npy"})
    EXPECT_EQ(content_of(at("r") / file), content_of(at("n") / file)) << file;
  const auto stats = read_json(at("r") / "stats.json");
  EXPECT_EQ(stats["host"]["core"], "rv32imfd");
  EXPECT_GT(stats["host"]["functions"].size(), 5u);
  EXPECT_FALSE(read_json(at("n") / "stats.json").contains("host"));
  EXPECT_THAT(content_of(at("r") / "report.html"), HasSubstr("the host makes networks and moves the mesh"));
  EXPECT_THAT(std::string(read_json(at("r") / "manifest.json")["command"]), HasSubstr("host.processor=rv32"));
}

TEST_F(CliHost, InstructionsAreSecondsOnHardware) {
  if (!has_core()) GTEST_SKIP() << "built without compiler or emulator";
  good("run two-nodes --steps 4 --host rv32 --set host.cpi=1.5 --set host.clock_mhz=50 --out r");
  const auto stats = read_json(at("r") / "stats.json");
  const double array = stats["array_cycles"], bus = stats["bus_cycles"],
               instructions = stats["host"]["instructions"], host = instructions * 1.5 / 50e6;
  EXPECT_GT(instructions, 1000);
  EXPECT_DOUBLE_EQ(stats["host"]["seconds"], host);
  EXPECT_DOUBLE_EQ(stats["hardware_seconds"], (array + bus) / 100e6 + host);
  EXPECT_DOUBLE_EQ(stats["timeline"]["host_with_both_idle"], host * 100e6);
}

TEST_F(CliHost, WordsThatTravelAloneChangeTheBusAndNoBit) {
  good("run two-nodes --steps 8 --out whole");
  good("run two-nodes --steps 8 --set host.dma=false --out words");
  EXPECT_EQ(content_of(at("words") / "positions.npy"), content_of(at("whole") / "positions.npy"));
  EXPECT_NE(content_of(at("words") / "steps.csv"), content_of(at("whole") / "steps.csv"));
}

TEST_F(CliHost, WholeNumbersFlyNativelyToo) {
  good("run two-nodes --steps 6 --set host.arithmetic=fixed --check --out f");
  const auto stats = read_json(at("f") / "stats.json");
  EXPECT_LT(double(stats["against_reference"]["median_host_error"]), 1e-3);
  good("run two-nodes --steps 6 --check --out d");
  EXPECT_FALSE(read_json(at("d") / "stats.json")["against_reference"].contains("median_host_error"));
}

TEST_F(CliHost, RefusesInALine) {
  refused("run two-nodes --host arm --out r", "native");
  refused("run two-nodes --host rv32 --level reference --out r", "--host");
  refused("run two-nodes --set host.arithmetic=fixed --set relax.stop=sum --out r",
          "relax.stop: found \"sum\" beside host.arithmetic");
  refused("run two-nodes --set host.cpi=0 --out r", "host.cpi");
}

} // namespace
} // namespace hopmesh::tests
