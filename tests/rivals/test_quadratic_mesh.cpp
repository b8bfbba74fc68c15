// The solvers on networks of a mesh at a step of 0.05 s: who is faster than whom, and by which power of dt
// omega.
#include "tests/rivals/meshes.h"
#include "tests/rivals/quadratics.h"

#include <gmock/gmock.h>

namespace hopmesh::rivals::testing {
namespace {

// A sheet of 12 x 12 nodes after a random push, its step of backward Euler expanded about no change; the
// scale is such that the answer's largest output is 1 / tightness: above 1 the box cuts it off.
Problem sheet_network(double k, double tightness) {
  Random random(21);
  const scene::Mesh mesh = sheet(12, k / 2);
  reference::Motion motion{};
  motion.rule = reference::Rule::backward_euler;
  motion.mass = mesh.mass, motion.drag = 0.2, motion.time_step = 0.05, motion.friction = 1;
  motion.force = {9.81, 3, 0};
  reference::State state = reference::initial_state(mesh, motion.rule);
  for (Eigen::Index n = 0; n < state.velocity.size(); ++n)
    if (!mesh.pinned[n / 3]) state.velocity[n] = random.between(-0.1, 0.1);
  const reference::Increment about = reference::increment(mesh, motion, state);
  const auto at_scale = [&](double scale) {
    const auto network = reference::network(mesh, about, scale, Vector::Zero(state.velocity.size()));
    return quadratic::reached(
        {network.W, network.I, Vector::Zero(state.velocity.size()), reference::testing::coloured(network.W)});
  };
  constexpr double far = 1e6;
  const double largest = quadratic::best_answer(at_scale(far)).V.lpNorm<Eigen::Infinity>();
  return at_scale(far * largest / tightness);
}

double sweeps(const quadratic::Race& race, const std::string& name) {
  for (const quadratic::Course& course : race.courses)
    if (course.name == name)
      return course.reached.back() ? static_cast<double>(course.reached.back()->sweeps) : 1e9;
  return 0;
}

const std::string& failure(const quadratic::Race& race, const std::string& name) {
  for (const quadratic::Course& course : race.courses)
    if (course.name == name) return course.failure;
  throw std::logic_error("no course " + name);
}

TEST(QuadraticMesh, OrderOfTheSolversWithoutABound) {
  for (const double k : {10., 100.}) {
    const quadratic::Race race = quadratic::race(sheet_network(k, 0.5), {{1e-4}, 20000}, never);
    ASSERT_TRUE(race.answer.convex);
    const std::vector<std::string> faster_first{"cholesky",     "conjugate_gradient",  "accelerated_gradient",
                                                "gauss_seidel", "hopfield_sequential", "hopfield_damped"};
    for (std::size_t n = 0; n + 1 < faster_first.size(); ++n)
      EXPECT_LT(sweeps(race, faster_first[n]), sweeps(race, faster_first[n + 1]))
          << faster_first[n] << ", k " << k;
    EXPECT_LT(sweeps(race, "sor_1.8"), sweeps(race, "gauss_seidel"));
    EXPECT_LT(sweeps(race, "gauss_seidel"), sweeps(race, "jacobi_damped"));
    EXPECT_LT(sweeps(race, "admm_hundredth"), sweeps(race, "gauss_seidel"));
    EXPECT_EQ(sweeps(race, "cholesky"), 1);
    EXPECT_THAT(failure(race, "jacobi"), ::testing::HasSubstr("the energy rose")) << "k " << k;
  }
}

// Ten times the stiffness: ten times the sweeps where neurons creep, sqrt 10 where there is momentum.
TEST(QuadraticMesh, MomentumTakesTheRoot) {
  const quadratic::Limits limits{{1e-4}, 50000};
  const quadratic::Race soft = quadratic::race(sheet_network(100, 0.5), limits, never);
  const quadratic::Race hard = quadratic::race(sheet_network(1000, 0.5), limits, never);
  for (const char* name : {"hopfield_coloured", "gauss_seidel"}) {
    EXPECT_GT(sweeps(hard, name), 5 * sweeps(soft, name)) << name;
    EXPECT_LT(sweeps(hard, name), 20 * sweeps(soft, name)) << name;
  }
  for (const char* name : {"accelerated_gradient", "conjugate_gradient"}) {
    EXPECT_GT(sweeps(hard, name), 1.5 * sweeps(soft, name)) << name;
    EXPECT_LT(sweeps(hard, name), 5 * sweeps(soft, name)) << name;
  }
}

TEST(QuadraticMesh, WithTheBoxInTheWay) {
  const Problem p = sheet_network(100, 1.5);
  const quadratic::Race race = quadratic::race(p, {{1e-6}, 50000}, never);
  EXPECT_LE(reference::kkt_violation({p.W, p.I}, race.answer.V), 1e-12);
  EXPECT_GT((race.answer.V.array().abs() == 1).count(), 0);
  EXPECT_THAT(failure(race, "cholesky"), ::testing::HasSubstr("a bound is active"));
  for (const char* name : {"projected_newton", "conjugate_gradient", "accelerated_gradient", "admm_tenth",
                           "admm_hundredth", "gauss_seidel", "hopfield_coloured"})
    EXPECT_EQ(failure(race, name), "") << name;
}

} // namespace
} // namespace hopmesh::rivals::testing
