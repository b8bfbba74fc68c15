// hopmesh solve by the stages that step further, and at rest by the inputs of neurons that may still move.
#include "tests/support/cli_test.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

class CliSolveStages : public Cli {
 protected:
  nlohmann::json summary_of(const std::string& folder) const {
    return read_json(at(folder + "/summary.json"));
  }
};

/// The box of docs/use/own-networks.md by each stage: the same answer, and fewer sweeps than the paper's.
TEST_F(CliSolveStages, EveryStageComesToTheSameAnswerByInputs) {
  good("solve box-random-100 --level reference --stop sum --share 1e-9 --sweeps 1000000 --out m");
  const double energy = summary_of("m")["energy"].get<double>();
  for (const std::string rule : {"projected", "momentum --set array.schedule=synchronous"})
    for (const std::string level : {"reference", "engine", "systemc"}) {
      const bool fixed = level != "reference";
      // The engine tells that it has no fast kernel for such links.
      const Finished f = hopmesh("solve box-random-100 --stop sum --out o --share " +
                                 std::string(fixed ? "1e-3" : "1e-9") + " --level " + level + " --rule " +
                                 rule + (fixed ? " --set formats.link=fixed<24,2,SC_RND,SC_SAT>" : ""));
      ASSERT_EQ(f.exit_code, 0) << f.err;
      EXPECT_TRUE(summary_of("o")["converged"].get<bool>()) << rule << level;
      EXPECT_LT(summary_of("o")["sweeps"].get<int>(), summary_of("m")["sweeps"].get<int>()) << rule << level;
      EXPECT_NEAR(summary_of("o")["energy"].get<double>(), energy, (fixed ? 1e-4 : 1e-9) * std::abs(energy));
      EXPECT_EQ(read_table(at("o/solve.csv")).rows(), 1 + summary_of("o")["sweeps"].get<std::size_t>());
    }
}

TEST_F(CliSolveStages, ATableOfMomentumCounts) {
  const std::string line = "solve box-random-100 --rule momentum --set array.schedule=synchronous --level ";
  for (const std::string level : {"reference", "engine"}) {
    good(line + level + " --out f");
    good(line + level + " --momentum 0 --out none");
    good(line + level + " --momentum 0.5,0.9 --out own");
    EXPECT_GT(summary_of("none")["sweeps"].get<int>(), summary_of("f")["sweeps"].get<int>());
    EXPECT_NE(content_of(at("own/solve.csv")), content_of(at("f/solve.csv")));
  }
}

// Ten digits from weights of 16 bits, at every level, with outputs at bounds and by every stage.
TEST_F(CliSolveStages, CorrectionsTakeAnswersBeyondTheWords) {
  for (const std::string level : {"reference", "engine", "systemc"})
    for (const std::string rule : {"projected", "momentum --set array.schedule=synchronous"}) {
      const std::string line = "solve box-random-100 --level " + level + " --rule " + rule;
      hopmesh(line + " --out plain"); // over-relaxation may ring in words of 16 bits, which corrections mend
      const std::string text = hopmesh(line + " --refinements 12 --out refined").out;
      const auto plain = summary_of("plain"), refined = summary_of("refined");
      EXPECT_FALSE(plain.contains("corrections"));
      EXPECT_GT(refined["corrections"]["kept"].get<int>(), 0) << line;
      EXPECT_GT(plain["kkt_residual"].get<double>(), 1e-6) << line;
      EXPECT_LT(refined["kkt_residual"].get<double>(), 1e-10) << line;
      EXPECT_LE(refined["energy"].get<double>(), plain["energy"].get<double>());
      EXPECT_EQ(content_of(at("plain/solve.csv")), content_of(at("refined/solve.csv")))
          << "of the first answer";
      EXPECT_THAT(text,
                  ::testing::ContainsRegex("corrections? in [0-9,]+ sweeps? more, [01] refused; residual "));
    }
}

TEST_F(CliSolveStages, MistakesOfCorrectionsAreToldInOneLine) {
  refused("solve two-neurons --refinements 1001", "--refinements");
  refused("solve memory-100 --refinements 2", "--refinements: found outputs that are signs");
  refused("solve box-random-100 --array prescaled --refinements 2",
          "--refinements: found array.normaliser = prescaled");
}

// Allowed; what is lost is told in a line.
TEST_F(CliSolveStages, MomentumTakesAnAsymmetricWAndSaysThatNoProofHolds) {
  write_text(at("W.mtx"), "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 -1\n2 2 -1\n1 2 0.25\n");
  write_text(at("I.mtx"), "%%MatrixMarket matrix array real general\n2 1\n0.5\n0.25\n");
  const std::string momentum =
      "solve W.mtx I.mtx --asymmetric --rule momentum --set array.schedule=synchronous ";
  for (const std::string level : {"reference", "engine"}) {
    const Finished f = hopmesh(momentum + "--level " + level);
    EXPECT_EQ(f.exit_code, 0) << f.err;
    EXPECT_THAT(f.err, ::testing::HasSubstr("W is not symmetric: with momentum no proof says"));
  }
  EXPECT_THAT(hopmesh("solve W.mtx I.mtx --asymmetric").err,
              ::testing::Not(::testing::HasSubstr("no proof")));
  refused("solve W.mtx I.mtx --asymmetric --refinements 1", "--refinements: found a W that is not symmetric");
}

TEST_F(CliSolveStages, MistakesOfStagesAreToldInOneLine) {
  refused("solve two-neurons --stop never", "--stop: found never, expected change, sum");
  refused("solve two-neurons --share 0.75", "--share: found 0.75, expected a number from 0 to 0.5");
  refused("solve two-neurons --momentum 0.5", "--momentum: found array.output = modified, expected momentum");
  refused("solve two-neurons --rule momentum",
          "array.schedule: found \"coloured\", expected \"synchronous\"");
  const std::string momentum =
      "solve two-neurons --set array.output=momentum --set array.schedule=synchronous ";
  refused(momentum + "--momentum 1.5", "--momentum: found 1.5, expected numbers from 0 to 1");
  refused(momentum + "--momentum 0,0 --set array.momentum_entries=1",
          "--momentum: found 2 numbers, expected at most the 1 of array.momentum_entries");
}

} // namespace
} // namespace hopmesh::tests
