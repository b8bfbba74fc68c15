// hopmesh info: numbers counted by hand and by the formulas of docs/hardware/cycles.md; --toml gives the
// files back.
#include "place.h"
#include "tests/support/cli_test.h"

#include <regex>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

class CliInfo : public Cli {
 protected:
  /// The value in the row of that name.
  static std::string row(const std::string& out, const std::string& name) {
    std::string start = "  " + name;
    start.resize(31, ' '); // where values begin
    for (const std::string& line : lines_of(out))
      if (line.rfind(start, 0) == 0) return line.substr(start.size());
    return "no row " + name;
  }
};

TEST_F(CliInfo, TwoNodesByHand) {
  const std::string out = good("info two-nodes").out;
  EXPECT_EQ(row(out, "nodes"), "2");
  EXPECT_EQ(row(out, "cells (free nodes)"), "1");
  EXPECT_EQ(row(out, "neurons"), "3 (3 a cell)");
  EXPECT_EQ(row(out, "links between cells"), "0");
  EXPECT_EQ(row(out, "inputs of a neuron"), "at most 3");
  EXPECT_EQ(row(out, "schedule"), "coloured, 3 phases a sweep (1 colour)");
  EXPECT_EQ(row(out, "longest phase"), "7 = 3 accumulate + 2 normalise + 2 output");
  EXPECT_EQ(row(out, "sweep"), "22");               // 3 * 7 + 1
  EXPECT_EQ(row(out, "prepare, once a run"), "22"); // 3 + 18 + 1
  EXPECT_EQ(row(out, "run of n sweeps"), "23 + 22 n");
  EXPECT_EQ(row(out, "load weights, bias, start"), "18 on the bus"); // (1 + 9) + 2 (1 + 3)
  // F = 15 + 14; I = 10, as a sum of 3 products and a bias lies within 3 + 256
  EXPECT_EQ(row(out, "accumulator"), "fixed<39,10,SC_TRN,SC_WRAP> (exact)");
  EXPECT_EQ(row(out, "pinned nodes"), "1: no cell, 3 neurons fewer");
  EXPECT_EQ(row(out, "springs to pinned nodes"), "1: in the bias, no link");
}

TEST_F(CliInfo, Flag400ByHand) {
  const std::string out = good("info flag-400").out;
  EXPECT_EQ(row(out, "nodes"), "400");
  EXPECT_EQ(row(out, "cells (free nodes)"), "380");
  EXPECT_EQ(row(out, "neurons"), "1,140 (3 a cell)");
  // Free: 20 rows of 19. Structural 20 * 18 + 19 * 19, shear 2 * 19 * 18.
  EXPECT_EQ(row(out, "links between cells"), "1,405");
  EXPECT_EQ(row(out, "inputs of a neuron"), "at most 27"); // 3 (1 + 8)
  EXPECT_EQ(row(out, "multipliers"), "1 a neuron, 1,140 in all");
  EXPECT_EQ(row(out, "schedule"), "coloured, 12 phases a sweep (4 colours)");
  EXPECT_EQ(row(out, "sweep"), "373");              // 12 (27 + 2 + 2) + 1
  EXPECT_EQ(row(out, "prepare, once a run"), "46"); // 27 + 18 + 1
  EXPECT_EQ(row(out, "run of n sweeps"), "47 + 373 n");
  EXPECT_EQ(row(out, "time of a sweep"), "3.73 us");
  EXPECT_EQ(row(out, "load weights, bias, start"),
            "30,993 on the bus");     // 1 + 9 (380 + 2 * 1405) + 2 (1 + 1140)
  EXPECT_EQ(row(out, "RESET"), "27"); // the longest row
  EXPECT_EQ(row(out, "registers and windows"), "256 KiB");
  EXPECT_EQ(row(out, "window WEIGHT"), "28,710 words at 0x20000");
  EXPECT_EQ(row(out, "window OUTPUT"), "1,140 words at 0xa000");
  EXPECT_EQ(row(out, "weights"), "56.1 KiB");                                 // 28,710 words of 16 bits
  EXPECT_EQ(row(out, "springs to pinned nodes"), "58: in the bias, no link"); // 20 + 38
  EXPECT_EQ(row(out, "springs between pinned nodes"), "19: no link");
}

TEST_F(CliInfo, FollowsTheArray) {
  const std::string descent = good("info flag-400 --array descent").out;
  EXPECT_EQ(row(descent, "longest phase"), "45 = 27 accumulate + 16 normalise + 2 output"); // divider: 14 + 2
  EXPECT_EQ(row(descent, "run of n sweeps"), "28 + 541 n");
  const std::string lanes = good("info flag-400 --set array.lanes=4 --set array.bus_bits=128").out;
  EXPECT_EQ(row(lanes, "longest phase"), "11 = 7 accumulate + 2 normalise + 2 output");
  EXPECT_EQ(row(lanes, "load weights, bias, start"),
            "7,751 on the bus"); // 1 + 7178 (of 4 words) + 2 (1 + 285)
  EXPECT_EQ(row(good("info flag-400 --set array.schedule=sequential").out, "schedule"),
            "sequential, 1,140 phases a sweep");
  EXPECT_EQ(row(good("info flag-400 --array prescaled").out, "run of n sweeps"), "1 + 361 n"); // 12 * 30 + 1
}

TEST_F(CliInfo, TellsTheRoundsOfAFold) {
  EXPECT_EQ(row(good("info flag-400").out, "elements"), "one a neuron");
  const std::string folded = good("info flag-400 --array folded").out;
  EXPECT_EQ(row(folded, "elements"), "16, shared by the neurons of a phase");
  EXPECT_EQ(row(folded, "multipliers"), "1 an element, 16 in all");
  EXPECT_EQ(row(folded, "output stage"), "modified, one for all");
  // 1 + 5 * 27 + 2 * 18 + 3 + 4
  EXPECT_EQ(row(folded, "longest phase"), "179, in 7 rounds of at most 27 to accumulate, output stage of 4");
  EXPECT_EQ(row(folded, "sweep"), "2,131");
  // The rounds of all phases, none shorter than the one before has neurons: 3 (2 (5 * 27 + 2 * 18) + 2 * 6 *
  // 27) cycles, the four neurons of the last one, and 19 for a reciprocal.
  EXPECT_EQ(row(folded, "prepare, once a run"), "2,021");
  const std::string each = good("info flag-400 --set array.elements=4 --set array.pipeline=2 "
                                "--set array.schedule=synchronous --set array.lanes=3")
                               .out;
  EXPECT_EQ(row(each, "multipliers"), "3 an element, 12 in all");
  EXPECT_EQ(row(each, "output stage"), "modified, one an element, 2 registers of pipeline");
  EXPECT_EQ(row(good("info flag-400 --set array.pipeline=2").out, "longest phase"),
            "33 = 27 accumulate + 2 normalise + 2 output + 2 pipeline");
}

TEST_F(CliInfo, TellsTheTimeOfAStepByHand) {
  const std::string out = good("info two-nodes --sweeps 10").out;
  EXPECT_THAT(out, ::testing::HasSubstr("A step of 10 sweeps\n"));
  EXPECT_EQ(row(out, "bus: load, start"), "28 cycles, 9.82 %");      // 5 * 2 + (1 + 9) + 2 (1 + 3)
  EXPECT_EQ(row(out, "array: START, prepare"), "23 cycles, 8.07 %"); // 1 + 22
  EXPECT_EQ(row(out, "array: sweeps"), "220 cycles, 77.2 %");
  EXPECT_EQ(row(out, "bus: read back"), "14 cycles, 4.91 %"); // 5 * 2 + (1 + 3)
  EXPECT_EQ(row(out, "bus and array together"), "285 cycles, 0.00285 ms at 100 MHz");
  EXPECT_EQ(row(out, "host, bus and array idle"), "a run tells it, where the host counts (host.processor)");
  // Three multipliers multiply nine weights a sweep.
  EXPECT_EQ(row(out, "utilisation"), "12.3 % of the array's cycles, 10.5 % of array and bus");
  const std::string twice = good("info two-nodes --sweeps 10 --set relax.expansions=2").out;
  EXPECT_THAT(twice, ::testing::HasSubstr("A step of 10 sweeps in 2 runs\n"));
  EXPECT_EQ(row(twice, "bus and array together"), "350 cycles, 0.0035 ms at 100 MHz"); // 285 + 28 + 23 + 14
  EXPECT_THAT(good("info flag-400").out, ::testing::HasSubstr("A step of 300 sweeps\n"))
      << "unasked, the scene's limit";
  EXPECT_EQ(hopmesh("info two-nodes --sweeps 0").exit_code, 2);
}

TEST_F(CliInfo, TellsSiliconByHand) {
  const std::string folded = good("info flag-400 --array folded").out;
  EXPECT_EQ(row(folded, "states"), "3.3 KiB");           // 1140 * 24 bits
  EXPECT_EQ(row(folded, "links"), "35.6 KiB, 16 times"); // 1140 * 16 * 16 bits
  EXPECT_EQ(row(folded, "norms"), "384 bits");           // 16 * 24
  EXPECT_EQ(row(folded, "reciprocals"), "3.2 KiB");      // 1140 (18 + 5) bits
  EXPECT_EQ(row(folded, "accumulators"), "1,248 bits");  // 16 * 2 * 39
  EXPECT_EQ(row(folded, "w L of the sums"), "4,096 bits");
  EXPECT_EQ(row(folded, "R u"), "432 bits");
  EXPECT_EQ(row(folded, "s r"), "702 bits");
  EXPECT_EQ(row(folded, "all multipliers"), "5,230 bits");
  EXPECT_EQ(row(folded, "subtractors of dividers"), "432 bits"); // 18 bits of a reciprocal, each of 24
  const std::string binary = good("info flag-400 --set array.output=binary").out;
  EXPECT_EQ(row(binary, "R u"), "no row R u");
  EXPECT_EQ(row(binary, "subtractors of dividers"), "no row subtractors of dividers");
  EXPECT_EQ(row(good("info flag-400 --array folded --set array.schedule=synchronous").out, "links"),
            "71.2 KiB, 16 times, in two banks"); // twice 291,840 bits
}

/// Docs show this picture.
TEST_F(CliInfo, DrawsTheMachine) {
  good("info flag-400 --array folded --picture machine.svg");
  const std::string svg = content_of(at("machine.svg"));
  EXPECT_EQ(svg, content_of(fs::path(HOPMESH_SOURCE_DIR) / "docs/pictures/machine.svg"))
      << "build-check/hopmesh info flag-400 --array folded --picture docs/pictures/machine.svg";
  for (const char* figure : {"28,710 × 16 bits", "in each of 16 memories", "a sweep takes 2,131 cycles",
                             "u = s · r: 39 × 18 bits", "one write a cycle", "Hold register"})
    EXPECT_THAT(svg, ::testing::HasSubstr(figure));
  good("info flag-400 --picture cells.svg");
  const std::string cells = content_of(at("cells.svg"));
  EXPECT_THAT(cells, ::testing::HasSubstr("1,140 neurons, nothing shared"));
  EXPECT_THAT(cells, ::testing::Not(::testing::HasSubstr("Hold register")));
  EXPECT_THAT(refused("info flag-400 --picture /proc/none/a.svg"), ::testing::HasSubstr("/proc/none"));
}

/// More elements than a phase has neurons are allowed, and told in a line.
TEST_F(CliInfo, TellsElementsThatNeverWork) {
  EXPECT_EQ(good("info flag-400 --set array.elements=100").err, "");
  EXPECT_EQ(
      good("info flag-400 --set array.elements=2000").err,
      "hopmesh: note: array.elements: 1,900 elements never work: 2,000 are more than the 100 neurons of "
      "the largest phase\n");
  EXPECT_EQ(
      good("solve two-neurons --set array.elements=3").err,
      "hopmesh: note: array.elements: 2 elements never work: 3 are more than the 1 neuron of the largest "
      "phase\n");
  EXPECT_EQ(good("solve two-neurons --set array.elements=1").err, "");
}

/// Weights of 16 bits go in pairs; a bias and a state of 24 do not, and it is told.
TEST_F(CliInfo, TellsWhatPackingDoes) {
  const std::string out = good("info flag-400 --set array.packing=true").out;
  EXPECT_EQ(row(out, "window WEIGHT"), "14,355 words at 0x10000, 2 codes each");
  EXPECT_EQ(row(out, "window BIAS"),
            "1,140 words at 0x8000, one code each: 24 bits are more than half a word");
  EXPECT_EQ(row(out, "load weights, bias, start"), "16,638 on the bus"); // 1 + 14,355 + 2 (1 + 1140)
  const std::string byte = good("info flag-400 --array byte --set array.packing=true").out;
  EXPECT_EQ(row(byte, "window WEIGHT"), "7,178 words at 0x10000, 4 codes each"); // 28,710 / 4, rounded up
  EXPECT_EQ(row(byte, "window BIAS"), "570 words at 0x8000, 2 codes each");
  EXPECT_EQ(row(byte, "window OUTPUT"), "285 words at 0x9000, 4 codes each");
}

TEST_F(CliInfo, TellsThatPackingHasNothingToPack) {
  const Finished wide = hopmesh("info flag-400 --set array.packing=true --set formats.weight=fixed<20,1>");
  EXPECT_EQ(wide.exit_code, 0);
  EXPECT_EQ(wide.err,
            "hopmesh: note: --set: array.packing: no effect here; it counts only with a weight, bias "
            "or state of at most 16 bits, or a table of m\n");
  EXPECT_EQ(row(wide.out, "load weights, bias, start"), "30,993 on the bus");
}

TEST_F(CliInfo, FollowsTheScene) {
  const std::string out = good("info two-nodes --set mesh.planar=true").out;
  EXPECT_EQ(row(out, "neurons"), "2 (2 a cell)");
  EXPECT_EQ(row(out, "third neuron of a cell"), "planar: y never moves");
  EXPECT_EQ(row(out, "sweep"), "13"); // 2 (2 + 2 + 2) + 1
}

TEST_F(CliInfo, SaysWhatEachSceneLeavesOut) {
  const auto left_out = [this](const std::string& scene, const std::string& name) {
    return row(good("info " + scene).out, name);
  };
  EXPECT_EQ(left_out("free-net", "pins"), "none given: every node has a cell");
  EXPECT_EQ(left_out("free-net", "drag of the air"), "none given");
  EXPECT_EQ(left_out("free-net", "start"), "up to 0.005 m off its place, seed 1, at rest");
  EXPECT_EQ(left_out("chain", "shear springs"), "weight 0: not built");
  EXPECT_EQ(left_out("chain", "third neuron of a cell"), "planar: y never moves");
  EXPECT_EQ(left_out("chain", "wind"), "none given");
  EXPECT_EQ(left_out("net", "error of the expansion"), "rest length 0: the energy is quadratic");
  EXPECT_EQ(left_out("cloth-rest", "inertia, speed"), "static: each step minimises springs and weight alone");
  EXPECT_EQ(left_out("banner", "friction"), "a factor of 1: none");
  EXPECT_EQ(left_out("flag-400", "acceleration before"), "memory 0: each step probes anew");
  EXPECT_EQ(left_out("flag-400-literal", "acceleration before"), "no row acceleration before");
  EXPECT_EQ(left_out("two-nodes --set force.gravity=[0,0,0]", "gravity"), "none given");
  EXPECT_EQ(left_out("two-nodes --set probe.beta=0", "unit-length term"), "beta 0: outputs of any length");
  EXPECT_EQ(left_out("banner --set motion.friction=0", "velocity"), "friction 0: each step starts from rest");
}

TEST_F(CliInfo, TomlGivesScenesAndArraysBack) {
  const std::string changes = " --steps 3 --set probe.gamma=123.25 --set mesh.pinned=[0] --set array.lanes=2";
  const std::string toml = good("info two-nodes --toml --array byte --set motion.steps=3 --set "
                                "probe.gamma=123.25 --set array.lanes=2")
                               .out;
  const auto cut = toml.find("\n# array\n");
  ASSERT_EQ(toml.rfind("# scene\n", 0), 0u);
  ASSERT_NE(cut, std::string::npos);
  write_text(at("s.toml"), toml.substr(0, cut + 1));
  write_text(at("a.toml"), toml.substr(cut + 1));
  expect_same_bits(results_of("two-nodes --array byte" + changes, "by-set"),
                   results_of("s.toml --array a.toml", "by-files"));
  EXPECT_EQ(good("info s.toml --array a.toml --toml").out, toml);
}

TEST_F(CliInfo, PrintsTheExpandedArray) {
  const std::string out = good("info two-nodes --array prescaled").out,
                    toml = good("info two-nodes --array prescaled --toml").out;
  EXPECT_THAT(out, ::testing::HasSubstr("Array file\n" + toml.substr(toml.find("# array\n") + 8)));
}

TEST_F(CliInfo, TellsAKeyWithoutEffect) {
  const Finished scene = hopmesh("info banner --set probe.gamma=1");
  EXPECT_EQ(scene.exit_code, 0);
  EXPECT_EQ(scene.err, "hopmesh: note: --set: probe.gamma: no effect here; it counts only with "
                       "motion.formulation = \"probe\"\n");
  const Finished array =
      hopmesh("solve two-neurons --array descent --set array.reciprocal_bits=9 --out solved");
  EXPECT_EQ(array.exit_code, 0);
  EXPECT_EQ(array.err, "hopmesh: note: --set: array.reciprocal_bits: no effect here; it counts only with "
                       "array.normaliser = \"reciprocal\"\n");
}

} // namespace
} // namespace hopmesh::tests
