// hopmesh budget: its table against the motions themselves, its sentences, what it refuses.
#include "tests/support/cli_test.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliBudget : public Cli {
 protected:
  const std::string small = "banner --set mesh.grid.rows=5 --set mesh.grid.columns=6";

  /// Positions of the last step.
  std::vector<double> end_of(const std::string& line, const std::string& out) const {
    const Array all = read_array(results_of(line, out) / "positions.npy");
    const auto size = static_cast<std::ptrdiff_t>(all.shape[1] * 3);
    return {all.values.end() - size, all.values.end()};
  }

  static double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum / (static_cast<double>(a.size()) / 3));
  }

  static void expect_shares_of_one(const Table& t, const std::vector<std::string>& parts) {
    for (std::size_t row = 0; row < t.rows(); ++row) {
      double sum = 0;
      for (const std::string& part : parts) sum += t.numbers(part + "_share")[row];
      EXPECT_NEAR(sum, 1, 1e-9);
    }
  }
};

// Each part is the distance of two runs that anybody can make: three sweeps end every relaxation of array and
// reference alike. The exact step: thirty expansions to rest, another way to Newton's answer.
TEST_F(CliBudget, PartsAreDistancesOfRuns) {
  const std::string line = small + " --steps 12 --set relax.threshold=0";
  const std::string few = " --set relax.max_sweeps=3";
  good("budget " + line + few + " --out b");
  const Table t = read_table(at("b") / "budget.csv");
  EXPECT_EQ(t.header, (std::vector<std::string>{"time", "total", "truth_floor", "sensitivity", "rounding",
                                                "rounding_share", "stopping", "stopping_share", "formulation",
                                                "formulation_share", "time_step", "time_step_share"}));
  ASSERT_EQ(t.rows(), 10u);
  const std::string rest = " --set relax.threshold=1e-14 --set relax.max_sweeps=20000";
  const auto run = end_of(line + few, "1"), reference = end_of(line + few + " --level reference", "2");
  const auto rested = end_of(line + " --level reference" + rest, "3");
  const auto exact = end_of(line + " --level reference --set relax.expansions=30" + rest, "4");
  EXPECT_DOUBLE_EQ(t.numbers("time").back(), 0.12);
  EXPECT_NEAR(t.numbers("rounding").back(), rms(run, reference), 1e-12);
  EXPECT_NEAR(t.numbers("stopping").back(), rms(reference, rested), 1e-11);
  EXPECT_NEAR(t.numbers("formulation").back(), rms(rested, exact), 1e-9);
  expect_shares_of_one(t, {"rounding", "stopping", "formulation", "time_step"});
  for (double floor : t.numbers("truth_floor")) EXPECT_LT(floor, 1e-8);
}

// Backward Euler is of order 1: half the step, half the part; friction is no part of what is compared.
TEST_F(CliBudget, TheTimeStepsPartHalvesWithIt) {
  good("budget " + small + " --time 0.1 --set motion.time_step=0.002 --out b");
  good("budget " + small + " --time 0.1 --set motion.time_step=0.001 --out c");
  const double coarse = read_table(at("b") / "budget.csv").numbers("time_step").back();
  const double fine = read_table(at("c") / "budget.csv").numbers("time_step").back();
  EXPECT_NEAR(coarse / fine, 2, 0.3);
}

// A factor on v and a drag of as much are the same in the limit; the exact step has the factor, so
// formulation stays what it is without friction: the linearised step.
TEST_F(CliBudget, FrictionIsAPartOfTheExactStep) {
  for (const std::string rule : {"backward_euler", "bdf2"}) {
    const std::string line = small + " --steps 10 --set motion.friction=0.95 --set incremental.rule=" + rule;
    good("budget " + line + " --out b");
    const std::string rest = " --set relax.threshold=1e-14 --set relax.max_sweeps=20000 --level reference";
    const double expected =
        rms(end_of(line + rest, "r"), end_of(line + rest + " --set relax.expansions=30", "e"));
    EXPECT_NEAR(read_table(at("b") / "budget.csv").numbers("formulation").back(), expected, 1e-9) << rule;
  }
}

TEST_F(CliBudget, TheProbeHasNoPartOfTheTimeStep) {
  const Finished f = good("budget two-nodes --steps 4 --out b");
  EXPECT_THAT(f.out, HasSubstr("The probe has no exact step"));
  const Table t = read_table(at("b") / "budget.csv");
  ASSERT_EQ(t.rows(), 4u);
  EXPECT_EQ(t.column.count("time_step"), 0u);
  expect_shares_of_one(t, {"rounding", "stopping", "formulation"});
  EXPECT_THAT(content_of(at("b") / "budget.svg"), HasSubstr("truth floor"));
}

TEST_F(CliBudget, SaysWhichStepsAreNotAtRest) {
  const Finished f = good("budget " + small + " --steps 4 --set relax.max_sweeps=2 --out b");
  EXPECT_THAT(f.out, HasSubstr("array guarded (4 of 4 steps not at rest)\n"));
  EXPECT_THAT(f.out, HasSubstr("reference, at rest in every step\n"));
}

TEST_F(CliBudget, ADivergedMotionIsTold) {
  const Finished f = hopmesh("budget two-nodes --set probe.gamma=1e9 --out b");
  EXPECT_EQ(f.exit_code, 1) << f.err;
  EXPECT_THAT(f.out, HasSubstr("array guarded: The motion diverged in step"));
}

TEST_F(CliBudget, RefusesInOneLine) {
  refused("budget two-node", "did you mean two-nodes?");
  refused("budget two-nodes --time 0", "found 0, expected a number above 0");
  refused("budget two-nodes --time 1e-9", "--time: found 1e-09, expected from one step of 0.05 s");
  refused("budget two-nodes --time 1 --steps 3", "--time");
  refused("budget two-nodes --set motion.friction=0", "motion.friction");
  EXPECT_FALSE(std::filesystem::exists(at("out")));
}

} // namespace
} // namespace hopmesh::tests
