// hopmesh solve and hopmesh problem: networks of somebody's own and of the problem set, at every level.
#include "tests/support/cli_test.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

/// Words of a command, joined.
std::string words(std::initializer_list<std::string_view> all) {
  std::string joined;
  for (const std::string_view word : all) joined.append(word).append(" ");
  return joined;
}

class CliSolve : public Cli {
 protected:
  /// A matrix of rows, as coordinates.
  void write_matrix(const std::string& name, const std::vector<std::vector<double>>& rows) const {
    std::string text, entries;
    std::size_t count = 0;
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t c = 0; c < rows[r].size(); ++c) {
        if (rows[r][c] == 0) continue;
        entries +=
            std::to_string(r + 1) + ' ' + std::to_string(c + 1) + ' ' + std::to_string(rows[r][c]) + '\n';
        ++count;
      }
    write_text(at(name), "%%MatrixMarket matrix coordinate real general\n" + std::to_string(rows.size()) +
                             ' ' + std::to_string(rows[0].size()) + ' ' + std::to_string(count) + '\n' +
                             entries);
  }
  void write_vector(const std::string& name, const std::vector<double>& values) const {
    std::string text = "%%MatrixMarket matrix array real general\n" + std::to_string(values.size()) + " 1\n";
    for (double v : values) text += std::to_string(v) + '\n';
    write_text(at(name), text);
  }
  std::vector<double> outputs(const std::string& folder) const {
    std::vector<double> V;
    for (const auto& row : read_market(at(folder + "/V.mtx")).values) V.push_back(row[0]);
    return V;
  }
  nlohmann::json summary(const std::string& folder) const { return read_json(at(folder + "/summary.json")); }

  /// A column of solve.csv.
  std::vector<double> column(const std::string& folder, const std::string& name) const {
    return read_table(at(folder + "/solve.csv")).numbers(name);
  }
  static void expect_to_fall(const std::vector<double>& energies, const std::string& what) {
    ASSERT_GT(energies.size(), 2u) << what;
    EXPECT_LT(energies.back(), energies.front()) << what;
    const double places = 1e-12 * std::fabs(energies.back()); // sums of doubles, each as good as its order
    for (std::size_t k = 1; k < energies.size(); ++k)
      EXPECT_LE(energies[k], energies[k - 1] + places) << what << ", sweep " << k;
  }
};

// (2a - b, 2b - a) = (1/4, 1/2): a = 1/3, b = 5/12, energy -I'V / 2.
TEST_F(CliSolve, TwoNeuronsOfMyOwn) {
  write_matrix("W.mtx", {{-2, 1}, {1, -2}});
  write_vector("bias.mtx", {0.25, 0.5});
  for (const std::string level : {"reference", "engine", "systemc", "systemc-clock"}) {
    const std::string said = good("solve W.mtx bias.mtx --out o --level " + level).out;
    EXPECT_THAT(said, HasSubstr("W.mtx: 2 neurons, 4 weights; level " + level + ","));
    EXPECT_THAT(said, HasSubstr(", modified, coloured"));
    EXPECT_THAT(said, HasSubstr("At rest after "));
    EXPECT_EQ(names_in(at("o")), (std::vector<std::string>{"V.mtx", "solve.csv", "summary.json"}));
    EXPECT_NEAR(outputs("o")[0], 1.0 / 3, 1e-3) << level;
    EXPECT_NEAR(outputs("o")[1], 5.0 / 12, 1e-3) << level;
    EXPECT_NEAR(summary("o")["energy"], -(0.25 / 3 + 0.5 * 5 / 12) / 2, 1e-5) << level;
    EXPECT_LT(summary("o")["kkt_residual"], 1e-3) << level;
    EXPECT_EQ(summary("o")["cycles"] == 0, level == "reference");
    EXPECT_EQ(read_table(at("o/solve.csv")).rows(), 1 + summary("o")["sweeps"].get<std::size_t>());
  }
}

TEST_F(CliSolve, WithoutBiasAndStartBothAreZero) {
  write_matrix("W.mtx", {{0, 1}, {1, 0}});
  good("solve W.mtx --out o");
  EXPECT_EQ(outputs("o"), (std::vector<double>{0, 0}));
  good("solve W.mtx --out b --rule binary"); // there it is 1
  EXPECT_EQ(outputs("b"), (std::vector<double>{1, 1}));
}

TEST_F(CliSolve, EmptyRowsStayAsTheyAre) {
  write_matrix("W.mtx", {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}});
  write_vector("bias.mtx", {0.5, 0, 0});
  write_vector("V0.mtx", {0, 0.25, 0});
  for (const char* rule : {"modified", "binary"})
    for (const char* level : {"reference", "engine", "systemc"}) {
      good(words({"solve W.mtx bias.mtx --start V0.mtx --out o --rule", rule, "--level", level}));
      EXPECT_EQ(outputs("o")[1], 0.25) << rule << ' ' << level;
      EXPECT_NE(outputs("o")[0], 0) << rule << ' ' << level;
    }
}

TEST_F(CliSolve, TheNetworkOfAStepComesToItsRest) {
  const std::string until_rest = " --set relax.threshold=1e-12 --set relax.max_sweeps=100000";
  good("network two-nodes --step 3 --out n" + until_rest);
  good("solve n/W.mtx n/bias.mtx --start n/V0.mtx --level reference --threshold 1e-12 --sweeps 100000 --out "
       "o");
  const Market rest = read_market(at("n/V.mtx"));
  for (std::size_t r = 0; r < rest.rows; ++r) EXPECT_NEAR(outputs("o")[r], rest.values[r][0], 1e-7) << r;
}

// ---- levels

TEST_F(CliSolve, EngineAndSystemcAreEqualBits) {
  for (const std::string name : {"memory-100", "cut-20", "queens-8", "box-random-100", "box-membrane-100"})
    for (const std::string rule : {"modified", "binary"})
      for (const std::string array : {"", " --array descent --set array.schedule=sequential",
                                      " --array prescaled --set array.schedule=synchronous --sweeps 50"}) {
        std::vector<nlohmann::json> ends;
        for (const std::string level : {"engine", "systemc"}) {
          hopmesh(words({"solve", name, "--rule", rule, array, "--out", level, "--level", level}));
          ends.push_back(summary(level));
          ends.back().erase("level");
        }
        EXPECT_EQ(ends[0], ends[1]) << name << rule << array;
        for (const char* file : {"V.mtx", "solve.csv"})
          EXPECT_TRUE(content_of(at("engine") / file) == content_of(at("systemc") / file))
              << name << rule << array << file;
      }
}

TEST_F(CliSolve, ArraysComeNearTheReference) {
  for (const std::string name : {"box-random-100", "box-membrane-1024", "box-random-1000"}) {
    good("solve " + name + " --level reference --threshold 1e-8 --sweeps 200000 --out r");
    good("solve " + name + " --out e");
    const double least = summary("r")["energy"], found = summary("e")["energy"];
    EXPECT_NEAR(found, least, 2e-3 * std::fabs(least)) << name;
  }
}

TEST_F(CliSolve, BinaryLevelsAgreeWithTheReferenceWhereWeightsAreExact) {
  for (const std::string name : {"cut-16", "cut-24"}) { // weights of 1, outputs of 1: nothing is rounded
    good("solve " + name + " --rule binary --level reference --out r");
    good("solve " + name + " --rule binary --out e");
    EXPECT_EQ(outputs("r"), outputs("e")) << name;
    EXPECT_EQ(summary("r")["sweeps"], summary("e")["sweeps"]) << name;
  }
}

// ---- energy

TEST_F(CliSolve, EnergyFallsInColouredAndSequentialOrder) {
  for (const std::string name : {"memory-100", "cut-24", "queens-8", "box-random-100", "box-corner-20"})
    for (const std::string rule : {"modified", "binary"})
      for (const std::string schedule : {"coloured", "sequential"})
        for (const std::string level : {"reference", "engine", "systemc"}) {
          const std::string line = words({"solve", name, "--rule", rule, "--level", level,
                                          "--array descent --set", "array.schedule=" + schedule});
          if (rule == "binary" && name == "box-random-100") continue; // W_ii < 0: see the next test
          hopmesh(line + " --threshold 0 --sweeps 60 --out o");
          expect_to_fall(column("o", level == "reference" ? "energy" : "loaded_energy"), line);
        }
}

// W_ii < 0 breaks the binary neuron's proof: it may turn for ever. A single neuron, W = -1: s = -V.
TEST_F(CliSolve, ABinaryNeuronThatPushesItselfAwayTurnsForEver) {
  write_matrix("W.mtx", {{-1}});
  const Finished f = hopmesh("solve W.mtx --rule binary --sweeps 10");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("Not at rest after 10 sweeps: limit cycle of 2"));
  EXPECT_THAT(good("solve W.mtx --rule modified").out, HasSubstr("At rest"));
}

// math: W = [[0, -1], [-1, 0]], V = (1, 1): all at once they flip for ever; one at a time they rest.
TEST_F(CliSolve, TwoNeuronsAtOnceFlipForEver) {
  for (const std::string rule : {"modified", "binary"})
    for (const std::string level : {"reference", "engine", "systemc"}) {
      const std::string line = words({"solve two-neurons --out o --rule", rule, "--level", level});
      const Finished f = hopmesh(line + " --set array.schedule=synchronous --sweeps 7");
      EXPECT_EQ(f.exit_code, 1) << level;
      EXPECT_THAT(f.out, HasSubstr("Not at rest after 7 sweeps: limit cycle of 2")) << level;
      EXPECT_EQ(summary("o")["limit_cycle"], 2) << level;
      EXPECT_EQ(column("o", "energy"), std::vector<double>(8, 1.0)) << level;
      EXPECT_EQ(outputs("o"), (std::vector<double>{-1, -1})) << level;
      for (const char* schedule : {"coloured", "sequential"}) {
        EXPECT_THAT(good(line + " --set array.schedule=" + schedule).out,
                    HasSubstr("At rest after 2 sweeps"));
        EXPECT_EQ(outputs("o"), (std::vector<double>{-1, 1})) << level;
      }
    }
}

// A single neuron, W = d < 0, I = b > 0, from below: V moves by (1 - V) (b + d V) / (|d| + b), so near the
// rest V* = -b / d its error shrinks by q = 1 - (1 - V*) |d| / (|d| + b) a sweep.
TEST_F(CliSolve, TheDiagonalSetsTheSpeed) {
  for (const double d : {-1.0, -4.0, -64.0}) {
    write_matrix("W.mtx", {{d}});
    write_vector("bias.mtx", {0.5});
    good("solve W.mtx bias.mtx --level reference --threshold 1e-7 --out o");
    const double rest = -0.5 / d, q = 1 - (1 - rest) * -d / (-d + 0.5);
    EXPECT_NEAR(outputs("o")[0], rest, 1e-6);
    const auto changes = column("o", "largest_change");
    EXPECT_NEAR(changes.back() / changes[changes.size() - 2], q, 1e-3) << d;
  }
}

// ---- flags

TEST_F(CliSolve, EveryFlagCounts) {
  EXPECT_EQ(hopmesh("solve box-random-100 --sweeps 3").exit_code, 1);
  EXPECT_THAT(hopmesh("solve box-random-100 --sweeps 3").out, HasSubstr("Not at rest after 3 sweeps"));
  EXPECT_NE(good("solve box-random-100 --threshold 1e-3").out, good("solve box-random-100").out);
  EXPECT_NE(good("solve box-random-100 --array descent").out, good("solve box-random-100").out);
  EXPECT_THAT(good("solve cut-20 --set array.schedule=sequential").out, HasSubstr("binary, sequential"));
  EXPECT_THAT(good("solve cut-20 --rule modified").out, HasSubstr("modified, coloured"));
  EXPECT_NE(good("solve queens-8 --seed 1").out, good("solve queens-8 --seed 2").out);
  EXPECT_EQ(good("solve queens-8 --seed 1").out, good("solve queens-8").out);
  EXPECT_THAT(good("solve memory-100").out, HasSubstr("recalled"));
}

TEST_F(CliSolve, TheRuleHasTwoNamesThatMayNotContradictEachOther) {
  refused("solve cut-20 --rule modified --set array.output=binary --out no",
          "--rule: found modified beside --set array.output=binary, expected one of the two");
  EXPECT_FALSE(std::filesystem::exists(at("no")));
  EXPECT_THAT(good("solve cut-20 --rule binary --set array.output=binary").out, HasSubstr("engine, binary,"));
  EXPECT_THAT(good("solve cut-20 --set array.output=modified").out, HasSubstr("engine, modified,"))
      << "what is asked for goes before the problem's own rule";
}

TEST_F(CliSolve, OneIsNotSeveral) {
  write_matrix("W.mtx", {{-2}});
  EXPECT_THAT(hopmesh("solve W.mtx --sweeps 1").out, HasSubstr("W.mtx: 1 neuron, 1 weight; "));
  EXPECT_THAT(hopmesh("solve box-random-100 --sweeps 1").out, HasSubstr("Not at rest after 1 sweep,"));
}

TEST_F(CliSolve, AsymmetricNetworksOnDemand) {
  write_matrix("W.mtx", {{0, 1, 0}, {0.5, -1, 0}, {0, 0.25, -1}});
  write_vector("bias.mtx", {0.1, 0, 0});
  refused("solve W.mtx --out no",
          "W.mtx: found W(1,2) = 1 but W(2,1) = 0.5, which differ most, by 0.5, expected a "
          "symmetric matrix, or --asymmetric");
  good("solve W.mtx bias.mtx --asymmetric --level engine --out e");
  good("solve W.mtx bias.mtx --asymmetric --level systemc --out s");
  EXPECT_EQ(outputs("e"), outputs("s"));
  EXPECT_GT(outputs("e")[0], 0.9); // nothing but a bias and what it made of its neighbour pulls it
}

TEST_F(CliSolve, BadFilesAreRefusedInOneLine) {
  write_matrix("W.mtx", {{-2, 1}, {1, -2}});
  write_matrix("wide.mtx", {{-2, 1, 0}, {1, -2, 0}});
  write_vector("three.mtx", {1, 2, 3});
  write_vector("far.mtx", {0.5, 1.5});
  write_vector("two.mtx", {0.5, 0.5});
  write_text(at("nan.mtx"), "%%MatrixMarket matrix array real general\n2 1\n1\nnan\n");
  write_text(at("vast.mtx"), "%%MatrixMarket matrix coordinate integer general\n2147483648 1 0\n");
  const std::vector<std::pair<std::string, std::string>> bad{
      {"wide.mtx", "wide.mtx: found 2 x 3, expected as many rows as columns"},
      {"W.mtx three.mtx", "three.mtx: found 3 rows, expected 2, as W has"},
      {"W.mtx vast.mtx", "vast.mtx: found 2147483648 rows, expected 2, as W has"},
      {"W.mtx two.mtx --start three.mtx", "three.mtx: found 3 rows, expected 2"},
      {"W.mtx W.mtx", "W.mtx: found 2 x 2, expected a vector: one column"},
      {"W.mtx two.mtx --start far.mtx", "far.mtx: found 1.5 in row 2, expected outputs from -1 to 1"},
      {"W.mtx nan.mtx", "nan.mtx:4: found \"nan\", expected a finite number"},
      {"none.mtx", "none.mtx: found no such file, expected a Matrix Market file"},
      {"W.mtx two.mtx --seed 2", "--seed: found a file, expected the name of a problem"},
      {"cut-20 two.mtx", "BIAS: found two.mtx, expected none"},
      {"cut-20 --start two.mtx", "two.mtx: found 2 rows, expected 20"},
      {"W.mtx --set formats.weight=fixed<32,1> --set formats.state=fixed<32,2> --set "
       "formats.link=fixed<32,2>",
       "formats whose exact sum fits 62 bits"},
  };
  for (const auto& [line, says] : bad) refused("solve " + line + " --out no", says);
  EXPECT_FALSE(std::filesystem::exists(at("no")));
}

// ---- the problem set

TEST_F(CliSolve, ProblemsAreListedAndWritten) {
  const auto lines = lines_of(good("problems").out);
  EXPECT_GE(lines.size(), 20u);
  EXPECT_THAT(good("problem queens-8 --seed 3 --out q").out, HasSubstr("queens-8: 8 queens on a board"));
  EXPECT_EQ(names_in(at("q")), (std::vector<std::string>{"V0.mtx", "W.mtx", "bias.mtx"}));
  good("solve q/W.mtx q/bias.mtx --start q/V0.mtx --out a");
  good("solve queens-8 --seed 3 --out b");
  EXPECT_TRUE(content_of(at("a/V.mtx")) == content_of(at("b/V.mtx")));
  EXPECT_TRUE(content_of(at("a/solve.csv")) == content_of(at("b/solve.csv")));
}

// ---- the stages that step further, and rest by sum

/// The box of docs/use/own-networks.md by each stage: the same answer, and fewer sweeps than the paper's.
TEST_F(CliSolve, EveryStageComesToTheSameAnswerByInputs) {
  good("solve box-random-100 --level reference --stop sum --share 1e-9 --sweeps 1000000 --out m");
  const double energy = summary("m")["energy"].get<double>();
  for (const std::string rule : {"projected", "momentum --set array.schedule=synchronous"})
    for (const std::string level : {"reference", "engine", "systemc"}) {
      const bool fixed = level != "reference";
      good("solve box-random-100 --stop sum --share 1e-9 --out o --level " + level + " --rule " + rule +
           (fixed ? " --set formats.link=fixed<24,2,SC_RND,SC_SAT>" : ""));
      EXPECT_TRUE(summary("o")["converged"].get<bool>()) << rule << level;
      EXPECT_LT(summary("o")["sweeps"].get<int>(), summary("m")["sweeps"].get<int>()) << rule << level;
      EXPECT_NEAR(summary("o")["energy"].get<double>(), energy, (fixed ? 1e-4 : 1e-9) * std::abs(energy));
      EXPECT_EQ(read_table(at("o/solve.csv")).rows(), 1 + summary("o")["sweeps"].get<std::size_t>());
    }
}

TEST_F(CliSolve, ATableOfMomentumCounts) {
  const std::string line = "solve box-random-100 --rule momentum --set array.schedule=synchronous --level ";
  for (const std::string level : {"reference", "engine"}) {
    good(line + level + " --out f");
    good(line + level + " --momentum 0 --out none");
    good(line + level + " --momentum 0.5,0.9 --out own");
    EXPECT_GT(summary("none")["sweeps"].get<int>(), summary("f")["sweeps"].get<int>());
    EXPECT_NE(content_of(at("own/solve.csv")), content_of(at("f/solve.csv")));
  }
}

TEST_F(CliSolve, MistakesOfStagesAreToldInOneLine) {
  refused("solve two-neurons --stop never", "--stop: found never, expected change or sum");
  refused("solve two-neurons --share 0.75", "--share: found 0.75, expected a number from 0 to 0.5");
  refused("solve two-neurons --momentum 0.5", "--momentum: found array.output = modified, expected momentum");
  refused("solve two-neurons --rule momentum",
          "array.schedule: found \"coloured\", expected \"synchronous\"");
  const std::string momentum = "solve two-neurons --rule momentum --set array.schedule=synchronous ";
  refused(momentum + "--momentum 1.5", "--momentum: found 1.5, expected numbers from 0 to 1");
  refused(momentum + "--momentum 0,0 --set array.momentum_entries=1",
          "--momentum: found 2 numbers, expected at most the 1 of array.momentum_entries");
}

} // namespace
} // namespace hopmesh::tests
