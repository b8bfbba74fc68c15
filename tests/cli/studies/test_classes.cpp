// Each class of a stability map, on a motion whose fate is known before it runs: by a formula, or by what is
// taken away from it.
#include "tests/support/cli_test.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::tests {
namespace {

class CliClass : public Cli {
 protected:
  /// The class that `hopmesh stability` would give a scene with these keys ("key = value" a line).
  std::string class_of(const std::string& scene, const std::string& method, const std::string& keys) {
    std::string study =
        fmt::format("scene = \"{}\"\nmethods = [\"{}\"]\n[axes.a]\nlabel = [1]\n", scene, method);
    for (const std::string& line : lines_of(keys)) study += line + "\n";
    const std::string name = fmt::format("s{}", ++studies_);
    write_text(at(name + ".toml"), study);
    good("sweep " + name + ".toml --out " + name);
    return read_table(at(name) / "results.csv").column.at("class").at(0);
  }

 private:
  int studies_ = 0;
};

/// The stiffest wave of the scene `chain`: docs/use/scene-files.md.
double omega() {
  return 2 * std::sqrt(200 / 0.1) * std::sin(19 * std::acos(-1.0) / 42);
}

std::string undamped_chain(double time_step) {
  return fmt::format("\"force.drag\" = 0.0\n\"motion.time_step\" = {}", time_step);
}

TEST_F(CliClass, BlowUpBeginsWhereTheFrequencySays) {
  EXPECT_EQ(class_of("chain", "velocity_verlet", undamped_chain(0.98 * 2 / omega())), "stable");
  EXPECT_EQ(class_of("chain", "velocity_verlet", undamped_chain(1.02 * 2 / omega())), "blow-up");
  const double rk4 = std::sqrt(8) / omega();
  EXPECT_EQ(class_of("chain", "rk4", undamped_chain(0.98 * rk4)), "stable");
  EXPECT_EQ(class_of("chain", "rk4", undamped_chain(1.2 * rk4)), "blow-up");
}

// Backward Euler leaves 1 / sqrt(1 + (dt omega)^2) of a wave's height a step: of the slowest wave, at 1 s, a
// seventh.
TEST_F(CliClass, OverDampedIsATooLongImplicitStep) {
  EXPECT_EQ(class_of("chain", "backward_euler", undamped_chain(1.0)), "over-damped");
  EXPECT_EQ(class_of("chain", "backward_euler", undamped_chain(0.001)), "stable");
}

// 0.4 (dt omega)^2 = 500 sweeps are needed, 20 are given: the springs never hear of each other.
TEST_F(CliClass, FalselySoftIsStarvedOfSweeps) {
  EXPECT_EQ(class_of("stiff", "engine", "\"relax.max_sweeps\" = 20\n\"motion.steps\" = 16"), "falsely soft");
}

// With words of four bits a place is 0.25: what a neuron would move by is less, and cut to nothing.
TEST_F(CliClass, LatticeStallIsAStepShorterThanAPlace) {
  const auto chain = [](int bits) {
    std::string keys = "\"motion.steps\" = 30\n\"motion.time_step\" = 0.01\n";
    for (const char* part : {"drive", "state", "link"})
      keys += fmt::format("\"formats.{}\" = \"fixed<{},2,SC_TRN_ZERO,SC_SAT>\"\n", part, bits);
    return keys + fmt::format("\"formats.weight\" = \"fixed<{},1,SC_RND,SC_SAT>\"", bits);
  };
  EXPECT_EQ(class_of("chain", "engine", chain(4)), "lattice stall");
  EXPECT_EQ(class_of("chain", "engine", chain(8)), "stable");
}

// At the scale that a step begins with, such words have no place small enough to move by: it must be sought
// until something moves, or the springs are never felt and the cloth flies off, in one sweep a step.
TEST_F(CliClass, CoarseWordsFeelTheSprings) {
  const struct {
    int k;
    double time_step;
    int bits;
  } cases[] = {{100, 0.016, 8}, {100, 0.008, 6}, {1000, 0.016, 8}};
  for (const auto& c : cases) {
    std::string line = fmt::format("run banner --array descent --steps 20 --out r --set motion.time_step={} "
                                   "--set mesh.springs.structural={} --set mesh.springs.shear={}",
                                   c.time_step, c.k / 2, c.k / 2);
    for (const char* part : {"drive", "state", "link"})
      line += fmt::format(" --set 'formats.{}=fixed<{},2,SC_TRN_ZERO,SC_SAT>'", part, c.bits);
    hopmesh(line + fmt::format(" --set 'formats.weight=fixed<{},1,SC_RND,SC_SAT>'", c.bits));
    const auto stats = read_json(at("r") / "stats.json");
    EXPECT_EQ(stats["outcome"], "finished") << line;
    EXPECT_GT(stats["sweeps"], 2 * 20) << line;
  }
}

// No length of rest, no unit-length term: each output heads for its bound, as the answer lies further than a
// step reaches.
TEST_F(CliClass, SaturatedIsAnAnswerOutOfReach) {
  const std::string far =
      "\"mesh.rest\" = 0.0\n\"probe.beta\" = 0.0\n\"probe.gamma\" = 0.0\n\"motion.steps\" = 16\n"
      "\"motion.time_step\" = 0.01\n\"mesh.planar\" = true\n\"mesh.grid.rows\" = 3\n\"mesh.grid.columns\" = "
      "3";
  EXPECT_EQ(class_of("two-nodes", "reference", far), "saturated");
  EXPECT_EQ(class_of("two-nodes", "engine", far), "saturated");
}

} // namespace
} // namespace hopmesh::tests
