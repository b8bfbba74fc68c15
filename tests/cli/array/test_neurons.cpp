// hopmesh vectors --neurons: files and folders for cores that are not ours, filled in by one in C++ and by
// one in Verilog, and judged.
#include "tests/support/cli_test.h"

#include "place.h"

#include <fstream>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliNeurons : public Cli {
 protected:
  /// The other neuron fills a blank file in; `fault`: "FIRING COLUMN MORE".
  void fill_in(const std::string& blank, const std::string& filled, const std::string& fault = "") const {
    const std::string command =
        HOPMESH_OTHER_NEURON " " + at(blank).string() + " " + at(filled).string() + " " + fault;
    ASSERT_EQ(run_shell(command).exit_code, 0) << command;
  }
  std::vector<std::string> lines(const std::string& name) const { return lines_of(content_of(at(name))); }
};

TEST_F(CliNeurons, AnotherNeuronFillsInRandomFiringsOfManyArraysAndIsRight) {
  const std::string rounding =
      "--set formats.accumulator=fixed<26,6,SC_RND_CONV,SC_WRAP> --set array.lanes=3 ";
  for (const std::string& array :
       {std::string(), std::string("--array descent --taps 4"), std::string("--array prescaled --taps 9"),
        std::string("--array byte --taps 1"), std::string("--set array.output=binary --taps 3"), rounding,
        rounding + "--set array.normaliser=divider --set formats.drive=fixed<20,3,SC_RND_ZERO,SC_SAT_ZERO>",
        rounding + "--set array.normaliser=prescaled --set formats.state=fixed<20,2,SC_RND_INF,SC_SAT>",
        rounding + "--set array.output=projected --set array.relaxation=25 --set array.normaliser=divider",
        std::string("--array descent-projected --taps 4"), std::string("--array descent-momentum --taps 4"),
        rounding +
            "--set array.output=momentum --set array.schedule=synchronous --set "
            "formats.state=fixed<15,2,SC_RND_CONV,SC_WRAP> --set formats.link=fixed<12,2,SC_TRN,SC_SAT>"}) {
    good("vectors --neurons --random 200 --seed 5 --blank --out b.txt " + array);
    fill_in("b.txt", "f.txt");
    EXPECT_THAT(
        good("vectors --neurons --check f.txt").out,
        HasSubstr("all right in s, N, r, u before the limiter, u, R, product, dV, V, Y, link (level engine)"))
        << array;
  }
}

TEST_F(CliNeurons, AnotherNeuronFillsInARunOfAScene) {
  good("vectors flag-225 --step 1 --sweeps 2 --array descent --neurons --blank --out b.txt");
  fill_in("b.txt", "f.txt");
  EXPECT_THAT(good("vectors --neurons --check f.txt --level systemc").out, HasSubstr("(level systemc)"));
}

struct Seeded {
  const char* column;
  int more;
  const char* says;
};

/// A core in which a stage is wrong, with everything that follows from it.
class CliNeuronsStage : public CliNeurons, public ::testing::WithParamInterface<Seeded> {};

TEST_P(CliNeuronsStage, IsNamedWithItsPlaces) {
  const Seeded& s = GetParam();
  good("vectors --neurons --random 60 --taps 5 --blank --out b.txt");
  fill_in("b.txt", "f.txt", "50 " + std::string(s.column) + " " + std::to_string(s.more));
  const Finished f = hopmesh("vectors --neurons --check f.txt");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.err, "");
  const auto all = lines("f.txt");
  std::size_t first = 0;
  while (all.at(first).rfind("fire", 0) != 0) ++first;
  EXPECT_THAT(f.out, HasSubstr("f.txt:" + std::to_string(first + 51) + ": firing 50: " + s.says));
}

const std::vector<Seeded> seeded{
    {"sum", 7, "s is wrong first (sum_0, as the bias leaves it): "},
    {"norm", 2, "N is wrong first (norm): "},
    {"reciprocal", -1, "r is wrong first (reciprocal): "},
    {"places", 1, "r is wrong first (places): "},
    {"ratio", 4, "u before the limiter is wrong first (ratio): "},
    {"drive", -2, "u is wrong first (drive): "},
    {"pull", 1, "R is wrong first (pull): "},
    {"product", 9, "product is wrong first (product): "},
    {"change", -5, "dV is wrong first (change): "},
    {"state_after", 3, "V is wrong first (state_after): "},
    {"extrapolated_after", 1, "Y is wrong first (extrapolated_after): "},
    {"link_after", 1, "link is wrong first (link_after): "},
};
INSTANTIATE_TEST_SUITE_P(Of, CliNeuronsStage, ::testing::ValuesIn(seeded),
                         [](const auto& made) { return std::string(made.param.column); });

TEST_F(CliNeurons, APlaceIsCountedEitherWay) {
  good("vectors --neurons --random 60 --taps 5 --blank --out b.txt");
  fill_in("b.txt", "f.txt", "50 change -5");
  EXPECT_THAT(hopmesh("vectors --neurons --check f.txt").out, HasSubstr(": 5 last places too low\n"));
  fill_in("b.txt", "f.txt", "50 pull 1");
  EXPECT_THAT(
      hopmesh("vectors --neurons --check f.txt").out,
      HasSubstr(": 1 last place too high\n  right before it: s, N, r, u before the limiter, u; edges: "));
}

TEST_F(CliNeurons, EveryLevelWritesTheSameFirings) {
  for (const char* what : {"two-nodes --step 3", "--random 50 --taps 6"})
    for (const char* format : {"text", "csv"}) {
      const std::string line = std::string("vectors --neurons ") + what + " --format " + format + " --out ";
      good(line + "engine");
      good(line + "systemc --level systemc");
      good(line + "clock --level systemc-clock");
      EXPECT_TRUE(content_of(at("engine")) == content_of(at("systemc"))) << line;
      EXPECT_TRUE(content_of(at("engine")) == content_of(at("clock"))) << line;
    }
}

TEST_F(CliNeurons, ARunOfASceneIsWhatItsVectorsTell) {
  good("vectors two-nodes --step 3 --out v.txt");
  good("vectors two-nodes --step 3 --neurons --format csv --out n.csv");
  std::vector<std::string> firings, answers;
  for (const std::string& line : lines("v.txt")) {
    const auto words = split(line, ' '); // a neuron a phase
    if (!words.empty() && words[0] == "fire")
      answers.push_back(words[1] + " " + words[2] + " " + words.back());
  }
  for (const std::string& line : lines("n.csv")) {
    const auto cells = split(line, ',');
    if (cells.size() > 3 && line[0] != '#' && cells[0] != "sweep" && cells[0] != "0")
      firings.push_back(cells[0] + " " + cells[1] + " " + cells[cells.size() - 3]);
  }
  EXPECT_FALSE(answers.empty());
  EXPECT_EQ(firings, answers);
}

TEST_F(CliNeurons, EdgesThatAnArrayCannotShowAreTold) {
  EXPECT_THAT(good("vectors --neurons --random 5 --array descent --out n.txt").out,
              HasSubstr("no firing of this array was found for "
                        "sum_tie+sum_overflow+drive_overflow+limited+link_tie+held+ahead_tie+ahead_held\n"));
  EXPECT_THAT(content_of(at("n.txt")), HasSubstr(" norm_zero+sum_zero+state_high "));
}

TEST_F(CliNeurons, StagesThatACoreDoesNotTellAreNotJudged) {
  good("vectors --neurons --random 5 --taps 2 --out n.csv --format csv");
  std::string text;
  for (const std::string& line : lines("n.csv")) {
    auto cells = split(line, ',');
    if (cells.size() > 3 && cells[0] != "sweep")
      for (std::size_t k = 13; k + 3 < cells.size(); ++k) cells[k] = "?"; // all but V, Y and the link
    for (std::size_t k = 0; k < cells.size(); ++k) text += (k ? "," : "") + cells[k];
    text += '\n';
  }
  write_text(at("n.csv"), text);
  const std::string out = good("vectors --neurons --check n.csv").out;
  EXPECT_THAT(out, HasSubstr("all right in V, Y, link (level engine)\nnot told, so not judged: s, N, r, "));
}

// ---- memories ----

/// The core in Verilog, built for a folder of the test's, run in it.
class CliNeuronsInVerilog : public CliNeurons {
 protected:
  void build(const std::string& folder) const {
    const Finished f =
        run_shell("cd " + around.folder.string() + " && verilator --binary -Wno-fatal -CFLAGS -O0 " +
                  "--top-module neuron_bench -Mdir obj +incdir+" + folder + " '-DNEURONS_DIR=\"" + folder +
                  "\"' " HOPMESH_SOURCE_DIR "/tests/cli/array/neuron_bench.sv");
    ASSERT_EQ(f.exit_code, 0) << f.out << f.err;
  }
  void run(const std::string& arguments = "") const {
    const Finished f = run_shell("cd " + around.folder.string() + " && obj/Vneuron_bench " + arguments);
    ASSERT_EQ(f.exit_code, 0) << f.out << f.err;
  }
};

TEST_F(CliNeuronsInVerilog, ACoreReadsTheMemoriesAnswersAndIsJudgedStageByStage) {
  good("vectors --neurons --random 100 --seed 3 --format memh --blank --set array.lanes=2 --out m");
  build("m");
  run();
  EXPECT_THAT(
      good("vectors --neurons --check m").out,
      HasSubstr("all right in s, N, r, u before the limiter, u, R, product, dV, V, Y, link (level engine)"));
  const std::vector<std::string> stages{"s", "N", "r", "u", "R", "dV", "V", "link"};
  for (std::size_t k = 0; k < stages.size(); ++k) {
    run("+firing=60 +stage=" + std::to_string(k + 1));
    const Finished f = hopmesh("vectors --neurons --check m --level systemc");
    EXPECT_EQ(f.exit_code, 1);
    EXPECT_THAT(f.out, HasSubstr("m: line 60: firing 60: " + stages[k] + " is wrong first ("));
    EXPECT_THAT(f.out, HasSubstr(": 1 last place too high\n"));
  }
  const std::string err = refused("vectors --neurons --random 5 --format memh --blank --out m");
  EXPECT_THAT(err, HasSubstr("sum.memh: --blank: found answers of before, expected a folder without them"));
}

TEST_F(CliNeurons, MemoriesHoldWhatTheTextHolds) {
  good("vectors --neurons --random 20 --taps 3 --out n.txt");
  good("vectors --neurons --random 20 --taps 3 --format memh --out m");
  EXPECT_THAT(good("vectors --neurons --check m").out, HasSubstr("all right in s, N, "));
  const auto layout = content_of(at("m") / "neuron_layout.vh");
  for (const char* line :
       {"localparam TAPS = 3; // of the longest row\n", "localparam LANES = 1;\n",
        "localparam NORMALISER = 1; // reciprocal\n",
        "localparam DRIVE_BITS = 18; // fixed<18,2,SC_RND,SC_SAT>\n",
        "localparam DRIVE_ROUNDING = 0; // SC_RND\n", "localparam ACCUMULATOR_EXACT = 1;\n",
        "localparam WEIGHT_COUNT = 3;\n", "localparam SUM_COUNT = 4;\n", "localparam EDGE_NORM_ZERO = 0;\n"})
    EXPECT_THAT(layout, HasSubstr(line));
  std::vector<std::int64_t> states, told;
  for (const std::string& line : lines("n.txt")) {
    const auto words = split(line, ' ');
    if (words[0] == "fire") states.push_back(std::stoll(words[words.size() - 3]));
  }
  for (const std::string& word : lines_of(content_of(at("m") / "state_after.memh")))
    told.push_back(static_cast<std::int32_t>(std::stoul(word, nullptr, 16) << 8) >> 8); // 24 bits
  EXPECT_EQ(told, states);
  EXPECT_THAT(layout, HasSubstr("localparam FIRINGS = " + std::to_string(states.size()) + ";\n"));
}

TEST_F(CliNeurons, MistakesAreToldInOneLine) {
  good("vectors --neurons --random 3 --taps 2 --out n.txt");
  good("vectors --neurons --random 3 --taps 2 --format memh --out m");
  const auto with = [this](const std::string& key, const std::string& line) {
    std::string text;
    for (const std::string& old : lines("n.txt")) text += (old.rfind(key, 0) == 0 ? line : old) + "\n";
    write_text(at("x.txt"), text);
    return refused("vectors --neurons --check x.txt");
  };
  EXPECT_THAT(with("hopmesh-neurons", "hopmesh-neurons 1"),
              HasSubstr("x.txt:1: found \"hopmesh-neurons 1\""));
  EXPECT_THAT(with("case", "csae one"), HasSubstr("expected case NAME (did you mean case?)"));
  EXPECT_THAT(with("lanes", "lanes 0"), HasSubstr("lanes: found 0, expected 1 to 64"));
  EXPECT_THAT(with("taps", "taps 0"), HasSubstr("found \"0\", expected taps, an integer from 1"));
  EXPECT_THAT(with("columns", "columns sweep neuron"), HasSubstr("expected column edges"));
  EXPECT_THAT(with("fire", "fired 1"), HasSubstr("(did you mean fire?)"));
  EXPECT_THAT(with("fire", "fire 0 0 - 1"), HasSubstr("found 4 cells, expected own"));
  EXPECT_THAT(with("fire", "fire 0 0 none 1"), HasSubstr("found \"none\", expected names of edges, or -"));
  EXPECT_THAT(with("fire", "fire 0 0 - 1 0 99999 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"),
              HasSubstr("weight 99999"));
  EXPECT_THAT(with("fire", "fire 0 0 - 1 0 0 0 0 0 0 0 0 0 ? ? ? ? ? ? ? ? ? ? ? ? ? ?"),
              HasSubstr("found no answer"));
  EXPECT_THAT(refused("vectors --neurons --check none.txt"), HasSubstr("found no such file"));
  EXPECT_THAT(refused("vectors --check n.txt"), HasSubstr("expected hopmesh-vectors 4"));
  write_text(at("m") / "drive.memh", "zz\n0g\n");
  EXPECT_THAT(refused("vectors --neurons --check m"), HasSubstr("drive.memh:2: found \"0g\""));
  std::filesystem::remove(at("m") / "weight.memh");
  EXPECT_THAT(refused("vectors --neurons --check m"), HasSubstr("weight.memh: found no such file"));
  std::filesystem::remove(at("m") / "array.txt");
  EXPECT_THAT(refused("vectors --neurons --check m"), HasSubstr("array.txt: found no such file"));
}

TEST_F(CliNeurons, FlagsThatDoNotGoTogetherAreRefused) {
  refused("vectors --random 3 --format csv --out x", "--format: found csv without --neurons");
  refused("vectors --random 3 --taps 3 --out x", "--taps: found 3 without --neurons");
  refused("vectors two-nodes --step 1 --neurons --taps 3 --out x", "--taps: found 3 without --random");
  refused("vectors --neurons --random 3 --format cvs --out x", "(did you mean csv?)");
  refused("vectors --neurons --check x --format csv", "--format: found csv beside --check");
  refused("vectors --neurons --random 3 --sweeps 2 --out x", "SCENE");
  refused("vectors --random 3 --array byte --out x", "--array, --set or --sweeps without a scene");
  refused("vectors --neurons --random 3 --taps 4000 --set formats.weight=fixed<28,1> --set "
          "formats.link=fixed<28,2> --set formats.state=fixed<28,2> --set formats.bias=fixed<16,2> --out x",
          "formats.weight: found fixed<28,1,SC_TRN,SC_WRAP>, expected formats whose exact sum fits 62 bits");
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
}

TEST_F(CliNeurons, NothingHalfWrittenIsLeft) {
  around.largest_file = 20000;
  for (const char* format : {"text", "csv"}) {
    EXPECT_EQ(hopmesh(std::string("vectors --neurons --random 300 --out v --format ") + format).exit_code, 2);
    EXPECT_EQ(names_in(around.folder), std::vector<std::string>{});
  }
  EXPECT_EQ(hopmesh("vectors --neurons --random 3000 --format memh --out m").exit_code, 2);
  EXPECT_EQ(names_in(at("m")), std::vector<std::string>{});
}

} // namespace
} // namespace hopmesh::tests
