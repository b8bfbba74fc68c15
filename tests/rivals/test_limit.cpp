// Where explicit methods blow up: the largest frequency of the mesh says it.
#include "sim/scene/frequency.h"
#include "tests/rivals/rival_meshes.h"
#include "tests/support/complaint.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace rivals;

/// Nearly at rest, disturbed a little everywhere: does the disturbance stay small?
bool holds(const std::string& name, const Physics& physics, double time_step) {
  State start = physics.initial_state();
  for (Eigen::Index k = 0; k < start.velocity.size(); ++k)
    if (physics.inverse_mass()[k] != 0) start.velocity[k] = 1e-9 * std::sin(1.0 + double(k * k % 997));
  const auto method = make_method(name, physics, time_step);
  method->start_from(start);
  const Vector rest = physics.initial_state().position;
  try {
    for (int k = 0; k < 3000; ++k) method->advance();
  } catch (const LostMotion&) {
    return false;
  }
  return (method->state().position - rest).lpNorm<Eigen::Infinity>() < 1e-6;
}

class RivalsStability : public ::testing::TestWithParam<std::tuple<std::string, double, double>> {};

TEST_P(RivalsStability, EndsWhereTheFrequencySays) {
  const auto& [name, limit, within] = GetParam();
  const scene::Mesh mesh = sheet(8, 50);
  const Physics physics(mesh, {});
  const double omega = scene::largest_frequency(mesh);
  EXPECT_TRUE(holds(name, physics, (1 - within) * limit / omega));
  EXPECT_FALSE(holds(name, physics, (1 + within) * limit / omega));
}

INSTANTIATE_TEST_SUITE_P(Of, RivalsStability,
                         ::testing::Values(std::tuple("symplectic_euler", 2.0, 0.01),
                                           std::tuple("velocity_verlet", 2.0, 0.01),
                                           std::tuple("rk4", 2 * std::sqrt(2.0), 0.03)),
                         [](const auto& made) { return std::get<0>(made.param); });

// Far beyond the explicit limit, where a compressed sheet buckles within a step.
TEST(RivalsLimit, ImplicitStepsHaveNone) {
  for (const std::string name : {"backward_euler", "bdf2", "linearly_implicit", "projective_dynamics"})
    for (const double alpha : {50.0, 5000.0}) {
      const scene::Mesh mesh = sheet(10, alpha);
      const Physics physics(mesh, banner_air);
      const auto method = make_method(name, physics, 0.05);
      for (int k = 0; k < 20; ++k) ASSERT_NO_THROW(method->advance()) << name << " alpha " << alpha;
      EXPECT_LT(method->positions().lpNorm<Eigen::Infinity>(), 3) << name << " alpha " << alpha;
    }
}

TEST(RivalsLimit, WhoDivergesSaysSoInASentence) {
  const scene::Mesh mesh = sheet(8, 50);
  const Physics physics(mesh, banner_air);
  const auto method = make_method("velocity_verlet", physics, 0.1);
  const std::string lost = complaint<LostMotion>([&] {
    for (int k = 0; k < 1000; ++k) method->advance();
  });
  EXPECT_NE(lost.find("velocity_verlet diverged in step"), std::string::npos) << lost;
}

} // namespace
} // namespace hopmesh::tests
