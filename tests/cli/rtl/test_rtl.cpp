// hopmesh rtl and the level rtl: a design that stands alone passes its own test bench in two simulators,
// every module is read by all tools, and the Verilated array is the array.
#include "tests/support/cli_test.h"

#include <fstream>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

bool has_program(const std::string& name) {
  return run_shell("command -v " + name + " > /dev/null").exit_code == 0;
}

#define NEEDS(program)                                                                                       \
  if (!has_program(program)) GTEST_SKIP() << "no program " program " here: packages-test.txt names it"

class CliRtl : public Cli {
 protected:
  CliRtl() {
    around.environment.emplace_back("HOPMESH_CACHE",
                                    HOPMESH_RTL_CACHE); // models of these tests are made once
    around.patience_seconds = 280;
  }
  Finished in_design(const std::string& command) const {
    return run_shell("cd " + at("design").string() + " && { " + command + "; } 2>&1");
  }
  /// As the design's own README says.
  std::string icarus() const {
    const Finished f = in_design(
        "iverilog -g2012 -Irtl -Itest -f hopmesh.f -o hopmesh.vvp test/hopmesh_test.v && vvp -n hopmesh.vvp");
    return f.out;
  }
};

// Nineteen cells: a phase has more neurons than elements, and Icarus is slow.
const std::string small = "two-nodes --set mesh.grid.columns=5 --set mesh.grid.rows=4";

const std::vector<std::string> arrays{
    "--array folded --set array.elements=4",
    "--array folded --set array.elements=2 --set array.stages=each --set array.pipeline=3",
    "--array descent --set array.elements=3 --set array.stages=one",
    "--array prescaled --set array.elements=4 --set array.schedule=synchronous",
    "--array descent-projected --set array.elements=4 --set array.stages=one",
    "--array descent-momentum --set array.elements=4 --set array.momentum_entries=20",
    "--array byte --set array.elements=1 --set array.schedule=sequential",
    "--array folded --set array.elements=4 --set array.output=binary"};

TEST_F(CliRtl, ADesignPassesItsOwnTestInIcarus) {
  NEEDS("iverilog");
  for (const std::string& array : arrays) {
    good("rtl " + small + " " + array + " --set relax.max_sweeps=4 --out design");
    EXPECT_THAT(icarus(), HasSubstr("PASSED")) << array;
  }
}

TEST_F(CliRtl, AxiAnswersAndRefusesAsItShould) {
  NEEDS("iverilog");
  good("rtl " + small + " " + arrays[0] + " --steps 0 --out design");
  const Finished f = in_design(
      "iverilog -g2012 -Irtl -f hopmesh.f -o axi.vvp test/hopmesh_axi_test.v && timeout 60 vvp -n axi.vvp");
  EXPECT_THAT(f.out, HasSubstr("PASSED"));
}

TEST_F(CliRtl, ItsTestFindsAWrongBit) {
  NEEDS("iverilog");
  good("rtl " + small + " --array folded --set array.elements=4 --set relax.max_sweeps=4 --out design");
  const auto file = at("design") / "rtl/hm_round.v";
  std::string text = content_of(file);
  const std::string right = "(MODE == RND) ? (beyond | (tie & tie_up))";
  ASSERT_NE(text.find(right), std::string::npos);
  text.replace(text.find(right), right.size(), "(MODE == RND) ? (beyond | (tie & tie_up) | rest)");
  std::ofstream(file) << text;
  EXPECT_THAT(icarus(), HasSubstr("FAILED"));
}

TEST_F(CliRtl, ADesignPassesItsOwnTestInVerilator) {
  NEEDS("verilator");
  good("rtl " + small + " " + arrays[0] + " --set relax.max_sweeps=4 --out design");
  const Finished f =
      in_design("verilator --binary --timing -Wno-fatal -Irtl -Itest -f hopmesh.f --top-module hopmesh_test "
                "test/hopmesh_test.v > build.log 2>&1; obj_dir/Vhopmesh_test");
  EXPECT_THAT(f.out, HasSubstr("PASSED")) << in_design("tail -20 build.log").out;
}

TEST_F(CliRtl, VerilatorHasNothingToSayAboutAnyModule) {
  NEEDS("verilator");
  for (const std::string& array : arrays) {
    good("rtl " + small + " " + array + " --steps 0 --out design");
    const Finished f =
        in_design("verilator --lint-only -Wall -Irtl -f hopmesh.f --top-module hopmesh_axi_top");
    EXPECT_EQ(f.out, "") << array;
  }
}

TEST_F(CliRtl, YosysReadsEveryModule) {
  NEEDS("yosys");
  good("rtl " + small + " " + arrays[0] + " --steps 0 --out design");
  const Finished f = in_design("yosys -q -p 'read_verilog -sv -Irtl rtl/*.v hopmesh_top.v hopmesh_axi_top.v; "
                               "hierarchy -check -top hopmesh_axi_top; proc; check -assert'");
  EXPECT_EQ(f.exit_code, 0) << f.out;
}

TEST_F(CliRtl, YosysMakesCellsOfIt) {
  NEEDS("yosys");
  good("rtl two-nodes --array byte --set array.elements=1 --steps 0 --out design");
  for (const std::string family : {"ice40", "ecp5"}) {
    EXPECT_EQ(in_design("yosys -q -s " + family + ".ys").exit_code, 0) << family;
    EXPECT_THAT(content_of(at("design") / (family + ".txt")),
                HasSubstr(family == "ice40" ? "SB_LUT4" : "LUT4"));
  }
}

TEST_F(CliRtl, TheCoreFileNamesEveryModule) {
  good("rtl two-nodes --array byte --set array.elements=1 --steps 0 --out design");
  const std::string core = content_of(at("design/rtl/hopmesh.core"));
  std::size_t modules = 0;
  for (const auto& entry : std::filesystem::directory_iterator(at("design/rtl")))
    if (entry.path().extension() == ".v") {
      EXPECT_THAT(core, HasSubstr("- " + entry.path().filename().string() + "\n"));
      modules += 1;
    }
  EXPECT_GT(modules, 20u);
}

TEST_F(CliRtl, WhatIsNotCoveredIsRefusedInALine) {
  refused("rtl net --out design", "array.elements: found 0, expected 1 to 256: RTL is of folded arrays");
  const std::string folded = "rtl net --array folded --out design --set ";
  const Finished many = hopmesh(folded + "array.elements=257"); // of which some never work: a note more
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_THAT(many.err, HasSubstr("array.elements: found 257, expected at most 256"));
  refused(folded + "array.stages=each --set array.elements=33",
          "array.elements: found 33, expected at most 32");
  refused(folded + "array.lanes=2", "array.lanes: found 2");
  refused(folded + "formats.accumulator=fixed<20,12>", "formats.accumulator");
  refused(folded + "array.bus_bits=64", "array.bus_bits: found 64");
  refused(folded + "array.packing=true", "array.packing: found true");
  refused("run net --level rtl --steps 1 --out run", "array.elements: found 0");
  EXPECT_FALSE(std::filesystem::exists(at("design")));
}

TEST_F(CliRtl, WithoutVerilatorTheLevelSaysSo) {
  around.environment = {{"HOPMESH_CACHE", at("none").string()}, {"PATH", at("nothing").string()}};
  refused("run net --array folded --set array.elements=1 --level rtl --steps 1 --out run",
          "level rtl: found no program verilator");
}

TEST_F(CliRtl, TheLevelIsTheArray) {
  NEEDS("verilator");
  const std::string motion = small + " --array folded --set array.elements=4 --steps 3 ";
  ASSERT_EQ(hopmesh("run " + motion + "--no-check --level rtl --out rtl").exit_code, 0);
  expect_same_bits(results_of(motion + "--no-check --level engine", "engine"), at("rtl"));
  const Finished f = good("compare " + motion + "--levels engine,systemc,rtl");
  EXPECT_THAT(f.out, HasSubstr("rtl"));
  good("vectors " + small + " --array folded --set array.elements=4 --step 2 --sweeps 3 --out v.txt");
  EXPECT_EQ(good("vectors --check v.txt --level rtl").exit_code, 0);
}

TEST_F(CliRtl, RandomNetworksOnGivenArraysAgree) {
  NEEDS("verilator");
  const Finished f = hopmesh("fuzz --levels engine,rtl --arrays folded --cases 300 --seed 5 --out fuzz");
  EXPECT_EQ(f.exit_code, 0) << f.out << f.err;
  EXPECT_THAT(f.out, HasSubstr("300 equal, 0 different"));
  refused("fuzz --levels engine,rtl --cases 3", "--arrays: found none");
}

} // namespace
} // namespace hopmesh::tests
