// The solvers on networks of a mesh at a step of 0.05 s: who is faster than whom, and by which power of dt
// omega.
#include "tests/networks/quadratics.h"
#include "tests/rivals/rival_meshes.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace solvers;

// A sheet of 12 x 12 nodes that billows, its step of backward Euler expanded about no change; the scale is
// such that the largest output of the answer without a box would be `peak`.
Problem sheet_network(double k, double peak) {
  const scene::Mesh mesh = sheet(12, k / 2);
  reference::StepParameters motion{};
  motion.formulation = &reference::backward_euler;
  motion.mass = mesh.mass, motion.drag = 0.2, motion.time_step = 0.05, motion.friction = 1;
  motion.force = {9.81, 3, 0};
  reference::State state = reference::initial_state(mesh, *motion.formulation);
  for (Eigen::Index n = 0; n < state.velocity.size(); ++n)
    if (!mesh.pinned[n / 3])
      state.velocity[n] = 0.3 * std::sin(3 * mesh.position[n / 3][0] + static_cast<double>(n % 3));
  const reference::Increment about = reference::increment(mesh, motion, state);
  const auto at_scale = [&](double scale) {
    const auto network = reference::network(mesh, about, scale, Vector::Zero(state.velocity.size()));
    return reached(problem_of(network.W, network.I, Vector::Zero(state.velocity.size())));
  };
  constexpr double far = 1e6;
  const double largest = best_answer(at_scale(far)).V.lpNorm<Eigen::Infinity>();
  return at_scale(far * largest / peak);
}

const SolverRun& run_of(const SolverRuns& all, const std::string& name) {
  for (const SolverRun& solver_run : all.runs)
    if (solver_run.name == name) return solver_run;
  throw std::logic_error("no run of " + name);
}

/// To the k-th gap; a billion where it was not reached.
double sweeps(const SolverRuns& all, const std::string& name, std::size_t k = 0) {
  const auto& reached = run_of(all, name).reached.at(k);
  return reached ? static_cast<double>(reached->sweeps) : 1e9;
}

const std::string& failure(const SolverRuns& all, const std::string& name) {
  return run_of(all, name).failure;
}

TEST(QuadraticMesh, OrderOfTheSolversWithoutABound) {
  for (const double k : {100., 1000.}) {
    const SolverRuns all = solvers::solve_with_all(sheet_network(k, 0.5), {{1e-4}, 20000}, never);
    ASSERT_TRUE(all.answer.convex);
    const std::vector<std::string> faster_first{"cholesky",     "conjugate_gradient",  "accelerated_gradient",
                                                "gauss_seidel", "hopfield_sequential", "hopfield_damped"};
    for (std::size_t n = 0; n + 1 < faster_first.size(); ++n)
      EXPECT_LT(sweeps(all, faster_first[n]), sweeps(all, faster_first[n + 1]))
          << faster_first[n] << ", k " << k;
    EXPECT_LT(sweeps(all, "gauss_seidel"), sweeps(all, "jacobi_damped"));
    EXPECT_LT(sweeps(all, "admm_hundredth"), sweeps(all, "gauss_seidel"));
    EXPECT_EQ(sweeps(all, "cholesky"), 1);
    EXPECT_THAT(failure(all, "jacobi"), ::testing::HasSubstr("the energy rose"));
  }
}

double condition(const Problem& p) {
  const Eigen::MatrixXd H = -Eigen::MatrixXd(p.W);
  const Vector values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H, Eigen::EigenvaluesOnly).eigenvalues();
  return values.tail(1)[0] / values[0];
}

// A harder spring worsens the matrix: two more digits cost as much more where neurons creep, the root of it
// where there is momentum.
TEST(QuadraticMesh, MomentumTakesTheRoot) {
  const Limits limits{{1e-6, 1e-8}, 50000};
  const Problem soft = sheet_network(30, 0.5), hard = sheet_network(300, 0.5);
  const double worse = condition(hard) / condition(soft);
  EXPECT_GT(worse, 4);
  const SolverRuns before = solvers::solve_with_all(soft, limits, never),
                   after = solvers::solve_with_all(hard, limits, never);
  const auto growth = [&](const char* name) {
    return (sweeps(after, name, 1) - sweeps(after, name)) / (sweeps(before, name, 1) - sweeps(before, name));
  };
  for (const char* name : {"gauss_seidel", "jacobi_damped"})
    EXPECT_NEAR(growth(name) / worse, 1, 0.3) << name << ", condition " << worse << " times";
  // N holds |I| too, which grows less than the curvature.
  for (const char* name : {"hopfield_coloured", "hopfield_sequential"}) {
    EXPECT_GT(growth(name), 1.4 * std::sqrt(worse)) << name << ", condition " << worse << " times";
    EXPECT_LT(growth(name), 1.3 * worse) << name << ", condition " << worse << " times";
  }
  for (const char* name : {"accelerated_gradient", "conjugate_gradient"})
    EXPECT_NEAR(growth(name) / std::sqrt(worse), 1, 0.4) << name << ", condition " << worse << " times";
}

TEST(QuadraticMesh, WithTheBoxInTheWay) {
  const Problem p = sheet_network(100, 1.5);
  const SolverRuns all = solvers::solve_with_all(p, {{1e-6}, 50000}, never);
  EXPECT_LE(reference::kkt_violation({p.W, p.I}, all.answer.V), 1e-12);
  EXPECT_GT((all.answer.V.array().abs() == 1).count(), 0);
  EXPECT_THAT(failure(all, "cholesky"), ::testing::HasSubstr("a bound is active"));
  for (const char* name : {"projected_newton", "conjugate_gradient", "accelerated_gradient", "admm_tenth",
                           "admm_hundredth", "gauss_seidel", "hopfield_coloured"})
    EXPECT_EQ(failure(all, name), "") << name;
}

/// A flag of 20 x 20 nodes, k = 100 N/m, hung by its first column in a wind, half a second under way on the
/// true path; its next step of 0.05 s, expanded about a place and started from it.
class FlagUnderWay : public ::testing::Test {
 protected:
  FlagUnderWay() {
    const rivals::Physics physics(mesh, {{3, 1, -9.81}, 0.2});
    const auto path = rivals::make_method("velocity_verlet", physics, 1e-4);
    for (int k = 0; k < 5000; ++k) path->advance();
    motion.formulation = &reference::backward_euler;
    motion.mass = mesh.mass, motion.drag = 0.2, motion.time_step = 0.05, motion.friction = 1;
    motion.force = {3, 1, -9.81};
    state.position = path->positions(), state.velocity = path->velocities();
    about = reference::increment(mesh, motion, state);
  }

  Problem from(const Vector& place) const {
    constexpr double room = 1e4; // m/s^2: no bound is near
    const Vector start = (place - about.predicted) / (about.h * room);
    const auto network = reference::network(mesh, about, room, start);
    return reached(problem_of(network.W, network.I, start));
  }
  static std::vector<double> counts(const Problem& p, const std::string& name) {
    const auto solver_run = run_solver(name, p, best_answer(p), {{1e-2, 1e-4, 1e-6}, 9999}, never);
    std::vector<double> sweeps;
    for (const auto& reached : solver_run.reached)
      sweeps.push_back(static_cast<double>(reached.value().sweeps));
    return sweeps;
  }

  const scene::Mesh mesh = sheet(20, 50);
  reference::StepParameters motion{};
  reference::State state = reference::initial_state(mesh, reference::backward_euler);
  reference::Increment about{};
};

// Counts of an older program that shared no code with this one (docs/findings/array-against-solvers.md): from
// where the mesh stands.
TEST_F(FlagUnderWay, TakesAsManySweepsAsAnotherProgramTook) {
  const Problem p = from(state.position);
  EXPECT_NEAR(condition(p), 784, 1);
  EXPECT_EQ(counts(p, "jacobi_damped"), (std::vector<double>{1352, 2768, 4185}));
  EXPECT_THAT(counts(p, "gauss_seidel"),
              ::testing::Pointwise(::testing::DoubleNear(2), std::vector<double>{337, 685, 1032}));
}

// The prediction has what is slow to come by already: the way of the mesh as a whole.
TEST_F(FlagUnderWay, ThePredictionIsABetterStart) {
  const auto still = counts(from(state.position), "gauss_seidel"),
             predicted = counts(from(about.predicted), "gauss_seidel");
  EXPECT_LT(8 * predicted[0], still[0]);
  EXPECT_LT(1.8 * predicted[2], still[2]);
}

} // namespace
} // namespace hopmesh::tests
