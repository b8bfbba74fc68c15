// hopmesh solvers: its table, its files, and what it says of networks that not all can solve.
#include "tests/support/cli_test.h"

#include <algorithm>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

// A banner of 6 x 6 nodes: quick, and convex as every network of an implicit step.
const std::string small = "banner --set mesh.grid.rows=6 --set mesh.grid.columns=6 ";

const std::vector<std::string> methods{"array",
                                       "array_corrected",
                                       "array_projected",
                                       "array_projected_corrected",
                                       "array_momentum",
                                       "array_momentum_corrected",
                                       "hopfield_coloured",
                                       "hopfield_sequential",
                                       "hopfield_synchronous",
                                       "hopfield_damped",
                                       "jacobi",
                                       "jacobi_damped",
                                       "gauss_seidel",
                                       "sor_1.8_sequential",
                                       "sor_1.8_by_component",
                                       "accelerated_gradient",
                                       "conjugate_gradient",
                                       "admm_tenth",
                                       "admm_hundredth",
                                       "projected_newton",
                                       "cholesky"};

class CliSolvers : public Cli {
 protected:
  Table table_of(const std::string& line) const {
    good("solvers " + line + " --out s");
    EXPECT_EQ(names_in(at("s")),
              (std::vector<std::string>{"multiplies.svg", "seconds.svg", "solvers.csv", "solvers.svg"}));
    return read_table(at("s/solvers.csv"));
  }
  /// A method's cell.
  static std::string cell(const Table& table, const std::string& method, const std::string& column) {
    const auto& names = table.column.at("method");
    const auto row = std::find(names.begin(), names.end(), method) - names.begin();
    return table.column.at(column).at(static_cast<std::size_t>(row));
  }
};

TEST_F(CliSolvers, ARowAMethodAndAColumnAGap) {
  const Table t = table_of(small + "--step 3");
  std::vector<std::string> header{"method"};
  for (const char* kind : {"sweeps", "cpu_seconds", "hardware_seconds", "array_cycles", "multiplies"})
    for (const char* gap : {"@0.01", "@0.0001", "@1e-06"}) header.push_back(std::string(kind) + gap);
  for (const char* name : {"factorisations", "sweeps_done", "sweeps_rising", "least_gap", "least_sweep",
                           "output_error", "told_error", "held", "error_bound", "failure"})
    header.emplace_back(name);
  EXPECT_EQ(t.header, header);
  EXPECT_EQ(t.column.at("method"), methods);
  for (const std::string& method : methods) {
    if (method == "jacobi" || method == "hopfield_synchronous") continue; // nothing holds these two
    if (method.rfind("array", 0) == 0) continue;                          // it stands still when it does
    EXPECT_EQ(cell(t, method, "failure"), "") << method;
    const int first = std::stoi(cell(t, method, "sweeps@0.01")),
              last = std::stoi(cell(t, method, "sweeps@1e-06"));
    EXPECT_LE(first, std::stoi(cell(t, method, "sweeps@0.0001"))) << method;
    EXPECT_GE(last, std::stoi(cell(t, method, "sweeps@0.0001"))) << method;
    EXPECT_EQ(std::to_string(last), cell(t, method, "sweeps_done")) << "the last gap is the end: " << method;
    EXPECT_GT(std::stod(cell(t, method, "cpu_seconds@0.01")), 0) << method;
  }
  EXPECT_EQ(cell(t, "cholesky", "sweeps@1e-06"), "1") << "one factorisation is the whole answer";
  EXPECT_EQ(cell(t, "cholesky", "factorisations"), "1");
  EXPECT_EQ(cell(t, "gauss_seidel", "sweeps_rising"), "0");
}

TEST_F(CliSolvers, TheTableSaysTheSame) {
  const std::string out = good("solvers " + small + "--step 3").out;
  EXPECT_THAT(out, HasSubstr("banner step 3: 90 outputs, ")); // 30 free nodes
  EXPECT_THAT(out, HasSubstr("convex, gaps to the exact answer"));
  for (const std::string& method : methods) EXPECT_THAT(out, HasSubstr('\n' + method + ' '));
  EXPECT_EQ(names_in(around.folder), std::vector<std::string>{}) << "no file without --out";
}

TEST_F(CliSolvers, GapsAndSweepsAreWhatWasAsked) {
  const Table t = table_of(small + "--step 2 --gap 1e-9,0.5 --max-sweeps 4");
  EXPECT_EQ(t.header[1], "sweeps@0.5");
  EXPECT_EQ(t.header[2], "sweeps@1e-09");
  EXPECT_EQ(cell(t, "hopfield_coloured", "sweeps@1e-09"), "");
  EXPECT_EQ(cell(t, "hopfield_coloured", "sweeps_done"), "4");
  EXPECT_THAT(cell(t, "hopfield_coloured", "failure"), HasSubstr("not there after 4 sweeps at a gap of "));
}

TEST_F(CliSolvers, StepAndSetChangeTheNetwork) {
  const auto sweeps = [this](const std::string& more) {
    return cell(table_of(small + more), "hopfield_sequential", "sweeps@1e-06");
  };
  const std::string one = sweeps("--step 1"), nine = sweeps("--step 9"),
                    long_step = sweeps("--step 1 --set motion.time_step=0.05");
  EXPECT_NE(one, nine);
  EXPECT_GT(std::stoi(long_step), 2 * std::stoi(one)) << "five times the step: far more sweeps";
}

// At step 0 there is no step before; later its change is a better start than none.
TEST_F(CliSolvers, ColdIsWithoutTheStepBefore) {
  const auto sweeps = [this](const std::string& more) {
    return table_of(small + more).column.at("sweeps@1e-06");
  };
  EXPECT_EQ(sweeps("--step 0"), sweeps("--step 0 --cold"));
  EXPECT_NE(sweeps("--step 5"), sweeps("--step 5 --cold"));
}

// A net that nothing pins or pulls flies on as it is: from where it stands, what is missing is one and the
// same way for all nodes, and a single step along the slope is the whole answer.
TEST_F(CliSolvers, StillIsFromWhereTheMeshStands) {
  const std::string flying = small + "--set mesh.pinned=[] --step 5";
  EXPECT_EQ(cell(table_of(flying + " --still"), "conjugate_gradient", "sweeps@1e-06"), "1");
}

TEST_F(CliSolvers, TheTimeStepAskedAboutIsNotTheMotions) {
  const auto sweeps = [this](const std::string& more) {
    return table_of(small + "--step 4 --still" + more).column.at("sweeps@1e-06");
  };
  const auto usual = sweeps("");
  EXPECT_EQ(usual, sweeps(" --time-step 0.01")) << "the scene's own";
  EXPECT_NE(usual, sweeps(" --time-step 0.05"));
}

TEST_F(CliSolvers, TheChartHasALineAMethod) {
  table_of(small + "--step 3");
  const std::string svg = content_of(at("s/solvers.svg"));
  for (const std::string& method : methods) EXPECT_THAT(svg, HasSubstr('>' + method + "</text>"));
  EXPECT_THAT(svg,
              HasSubstr("hopmesh solvers banner --set mesh.grid.rows=6 --set mesh.grid.columns=6 --step 3"));
}

// Compressed springs curve the probe's networks both ways: some methods do not apply, and the others are told
// apart all the same.
TEST_F(CliSolvers, ANetworkOfTheProbeIsNotConvex) {
  const std::string line =
      "flag-225 --set mesh.grid.rows=4 --set mesh.grid.columns=4 --set mesh.rest=2 --step 3 --gap 1e-2";
  const std::string out = good("solvers " + line).out;
  EXPECT_THAT(out, HasSubstr("not convex, gaps to the lowest energy found"));
  EXPECT_THAT(out, ::testing::ContainsRegex("conjugate_gradient[^\n]*needs a convex energy"));
  EXPECT_THAT(out, ::testing::ContainsRegex("cholesky[^\n]*needs a convex energy"));
}

// The motion until then is relaxed in the array's schedule; at step 0 there is none.
TEST_F(CliSolvers, OtherArraysDoNotChangeTheQuestion) {
  const auto counts = [this](const std::string& more) {
    auto column = table_of(small + "--step 0" + more).column.at("sweeps@1e-06");
    column.erase(column.begin(), column.begin() + 6); // the array's own
    return column;
  };
  EXPECT_EQ(counts(""), counts(" --array descent"));
}

TEST_F(CliSolvers, ABinaryArrayIsNoWayToThisAnswer) {
  const Table t = table_of(small + "--step 0 --still --set array.output=binary --max-sweeps 3");
  EXPECT_THAT(cell(t, "array", "failure"), HasSubstr("outputs are binary"));
}

TEST_F(CliSolvers, ANetworkAtRestLeavesNothingToSolve) {
  const Finished f =
      hopmesh("solvers " + small + "--step 0 --set force.gravity=[0,0,0] --set force.wind=[0,0,0]");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.out, "banner step 0: the network starts at its rest; there is nothing to solve\n");
}

TEST_F(CliSolvers, ADivergedMotionIsExitOneAndNoFile) {
  const Finished f = hopmesh("solvers two-nodes --set force.gravity=[0,0,-1e6] --step 30 --out s");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, HasSubstr("diverged in step"));
  EXPECT_TRUE(names_in(at("s")).empty());
}

} // namespace
} // namespace hopmesh::tests
