// Two methods of SUNDIALS that share only the equation of motion, and a closed form.
#include "sim/rivals/truth.h"
#include "tests/rivals/rival_meshes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace rivals;

TEST(RivalsTruth, OfAWeightOnASpringIsTheClosedForm) {
  const scene::Mesh mesh = hanging_weight();
  const Physics physics(mesh, falling);
  const std::vector<double> times{0.3, 1, 2.5};
  const Truth truth = solve(physics, times);
  const double decay = 0.15, w = std::sqrt(20 - decay * decay);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double t = times[k];
    const double z = -1.1 + std::exp(-decay * t) * 0.1 * (std::cos(w * t) + decay / w * std::sin(w * t));
    EXPECT_NEAR(truth.positions[k][5], z, 1e-10);
    EXPECT_LT(truth.floor[k], 1e-9);
  }
}

TEST(RivalsTruth, OfTheBannerAgreesWithItself) {
  const scene::Mesh mesh = sheet(10, 50);
  const Physics physics(mesh, banner_air);
  const Truth truth = solve(physics, {0.25, 0.5}, 1e-11);
  EXPECT_LT(truth.floor[0], 1e-8);
  EXPECT_LT(truth.floor[1], 1e-8);
  EXPECT_GT(truth.floor[1], 0) << "the two are one";
}

TEST(RivalsTruth, RefusesWhatItCannotTell) {
  const scene::Mesh mesh = hanging_weight();
  const Physics physics(mesh, falling);
  EXPECT_THROW(solve(physics, {1, 0.5}), std::invalid_argument);
  EXPECT_THROW(solve(physics, {1}, 0.1), std::invalid_argument);
  EXPECT_THROW(make_method("verlet", physics, 0.1), std::invalid_argument);
  EXPECT_THROW(make_method("rk4", physics, 0), std::invalid_argument);
}

} // namespace
} // namespace hopmesh::tests
