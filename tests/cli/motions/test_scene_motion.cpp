// Shipped scenes against what is known of them: closed forms, conservation, and solvers that share nothing
// with the array.
#include "sim/scene/frequency.h"
#include "sim/scene/scene_file.h"
#include "tests/cli/motions/scene_motion.h"

namespace hopmesh::tests {
namespace {

constexpr double g = 9.81;

/// The scene `chain` by its formulas; z counts upwards from the pin.
struct Chain {
  static constexpr std::size_t n = 10; ///< free nodes, numbered from 1
  static constexpr double pitch = 0.1, mass = 0.1, k = 200, drag = 10, dt = 0.01;

  static double wave(std::size_t j) { return (2.0 * double(j) - 1) * std::acos(-1.0) / (4 * n + 2); }
  static double omega(std::size_t j) { return 2 * std::sqrt(k / mass) * std::sin(wave(j)); }
  static double shape(std::size_t j, std::size_t i) { return std::sin(2 * wave(j) * double(i)); }

  /// Each link is longer by what hangs below it.
  static double rest(std::size_t node) {
    double z = 0;
    for (std::size_t i = 1; i <= node; ++i) z -= pitch + double(n - i + 1) * mass * g / k;
    return z;
  }

  /// z of a node where wave j has the share `left(j)` of its height at the start, when no link is longer.
  template <class Left> static double z(std::size_t node, Left left) {
    double z = rest(node);
    for (std::size_t j = 1; j <= n; ++j) {
      double height = 0;
      for (std::size_t i = 1; i <= n; ++i) height += shape(j, i) * (-pitch * double(i) - rest(i));
      z += left(j) * height / ((2 * n + 1) / 4.0) * shape(j, node);
    }
    return z;
  }

  /// A wave of height 1, let go, after so many steps of backward Euler.
  static double backward_euler(std::size_t j, std::size_t steps) {
    double q = 1, v = 0;
    for (std::size_t k = 0; k < steps; ++k) {
      v = (v - dt * omega(j) * omega(j) * q) / (1 + drag * dt + std::pow(omega(j) * dt, 2));
      q += dt * v;
    }
    return q;
  }
};

TEST_F(SceneMotion, ChainIsItsWavesStepByStep) {
  const Positions exactly = exact("chain"), array = positions("chain");
  double error = 0, of_array = 0;
  for (const std::size_t step : {1u, 2u, 5u, 20u, 60u, 150u})
    for (std::size_t i = 1; i <= Chain::n; ++i) {
      const double z = Chain::z(i, [&](std::size_t j) { return Chain::backward_euler(j, step); });
      error = std::max(error, std::fabs(exactly.at(step, i, 2) - z));
      of_array = std::max(of_array, std::fabs(array.at(step, i, 2) - z));
      EXPECT_EQ(array.at(step, i, 1), 0);
    }
  EXPECT_LT(error, 1e-10);
  EXPECT_LT(of_array, 1e-3) << "of a fall of 0.27 m";
}

TEST_F(SceneMotion, ChainComesToHangAsItsClosedFormSays) {
  const Positions exactly = exact("chain --steps 600"), array = positions("chain");
  for (std::size_t i = 1; i <= Chain::n; ++i) {
    EXPECT_NEAR(exactly.at(600, i, 2), Chain::rest(i), 1e-9);
    EXPECT_NEAR(array.at(300, i, 2), Chain::rest(i), 1e-3);
  }
}

// In continuous time a wave swings as cos(omega t): all ten frequencies, by a method of order 4.
TEST_F(SceneMotion, ChainSwingsAtItsTenFrequencies) {
  const Positions p =
      positions("chain --level rk4 --set force.drag=0 --set motion.time_step=0.001 --steps 500");
  for (std::size_t i = 1; i <= Chain::n; ++i) {
    const double z = Chain::z(i, [](std::size_t j) { return std::cos(Chain::omega(j) * 0.5); });
    EXPECT_NEAR(p.at(500, i, 2), z, 2e-8);
  }
  const scene::Mesh mesh = scene::build_mesh(scene::read_inputs("chain", "", {}).scene);
  EXPECT_NEAR(scene::largest_frequency(mesh), Chain::omega(Chain::n), 1e-4 * Chain::omega(Chain::n));
}

/// How far the centre of mass is from where its weight takes it; backward Euler falls by g dt^2 n (n + 1)
/// / 2.
double centre_error(const Positions& p) {
  double error = 0;
  for (std::size_t n = 1; n <= p.steps(); ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double fall = axis == 2 ? g * 1e-4 * double(n * (n + 1)) / 2 : 0;
      error = std::max(error, std::fabs(p.centre(n, axis) - p.centre(0, axis) + fall));
    }
  return error;
}

TEST_F(SceneMotion, FreeNetFallsAsItsCentreMust) {
  const Positions exactly = exact("free-net");
  EXPECT_LT(centre_error(exactly), 1e-12);
  EXPECT_GT(distance(exactly, positions("free-net --set mesh.start.shuffle=0"), 50), 1e-3)
      << "nothing moved inside";
}

// A net thrown whole: no spring ever works, every level flies it by its own recurrence, a truth by the
// parabola.
TEST_F(SceneMotion, AThrownNetFliesAsAStone) {
  const std::string thrown = "free-net --steps 20 --set mesh.start={velocity=[1.0,-2.0,3.0]} "
                             "--set motion.time_step=0.005 --level ";
  const double v[3] = {1, -2, 3}, dt = 0.005;
  for (const char* level : {"reference", "engine", "backward_euler", "rk4", "velocity_verlet", "xpbd"}) {
    const Positions p = positions(thrown + level);
    const bool exact = level == std::string("rk4") || level == std::string("velocity_verlet");
    const double bound = level == std::string("engine") ? 2e-5 : 1e-12;
    for (const std::size_t n : {1u, 20u})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double k = double(n), fall = axis == 2 ? g * dt * dt * k * (exact ? k : k + 1) / 2 : 0;
        for (const std::size_t node : {0u, 63u})
          EXPECT_NEAR(p.at(n, node, axis), p.at(0, node, axis) + v[axis] * dt * k - fall, bound) << level;
      }
  }
}

// Half a second at 16 bits on the links: 1.23 m of fall, and what docs/use/scene-files.md promises.
TEST_F(SceneMotion, FreeNetKeepsItsMomentumToTheArraysWords) {
  const double coarse = centre_error(positions("free-net"));
  EXPECT_LT(coarse, 2e-4);
  EXPECT_LT(centre_error(positions("free-net --set relax.threshold=1e-5")), coarse / 2);
}

TEST_F(SceneMotion, StiffAgreesWithNewtonWhereExplicitMethodsDie) {
  const Positions newton = positions("stiff --level backward_euler --steps 5");
  const std::string exactly =
      "stiff --level reference --steps 5 --set relax.threshold=1e-9 --set relax.expansions=3";
  EXPECT_LT(distance(positions(exactly), newton, 5), 1e-8);
  EXPECT_LT(distance(positions("stiff --steps 5"), newton, 5), 1e-5);
  EXPECT_EQ(hopmesh("run stiff --level velocity_verlet --out verlet").exit_code, 1);
}

TEST_F(SceneMotion, LargeStepHoldsAndDampsAsNewtonDoes) {
  // Such a step has several minima, folds of the cloth that differ by millimetres and by a hundred-thousandth
  // of the energy: the reference need not find Newton's.
  const std::string small = "large-step --set mesh.grid.rows=6 --set mesh.grid.columns=6 --steps 3 --level ";
  const auto energies = [&](const std::string& how, const std::string& folder) {
    return read_table(results_of(small + how, folder) / "steps.csv").numbers("energy");
  };
  const auto exactly = energies("reference --set relax.threshold=1e-9 --set relax.max_sweeps=100000 "
                                "--set relax.expansions=100",
                                "exactly"),
             by_newton = energies("backward_euler", "by_newton");
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(exactly[k] / by_newton[k], 1, 1e-4) << "step " << k;
  const Positions newton = positions("large-step --level backward_euler"), array = positions("large-step");
  const Positions truth = positions("large-step --level rk4 --set motion.time_step=0.002 --steps 2000");
  EXPECT_LT(distance(array, newton, 20), distance(newton, truth, 20, 2000)) << "of the step's own error";
  EXPECT_EQ(hopmesh("run large-step --level rk4 --out rk4").exit_code, 1);
}

TEST_F(SceneMotion, RandomStartFindsTheClothAgain) {
  const Positions crumpled = positions("random-start"),
                  flat = positions("random-start --set mesh.start.shuffle=0");
  EXPECT_GT(distance(crumpled, flat, 0), 0.09); // 0.1 m each way: 0.1 rms over three axes, 19 of 20 columns
  EXPECT_LT(distance(crumpled, flat, 300), 0.01);
  const Table once =
      read_table(results_of("random-start --no-check --set relax.expansions=1", "once") / "steps.csv");
  EXPECT_GT(once.numbers("kinetic").back(), 1) << "one expansion is enough after all: mend the scene's words";
}

TEST_F(SceneMotion, LevelsAgreeToTheBit) {
  for (const char* line : {"chain --steps 40", "free-net --steps 8", "stiff --steps 2",
                           "large-step --steps 1 --set relax.max_sweeps=200", "random-start --steps 3"})
    expect_equal_levels(line);
}

} // namespace
} // namespace hopmesh::tests
