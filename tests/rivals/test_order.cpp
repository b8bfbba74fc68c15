// Halving the time step on the banner divides the error by 2 to the order.
#include "sim/rivals/truth.h"
#include "tests/rivals/rival_meshes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace rivals;

constexpr double until = 0.08; // s

class RivalsOrder : public ::testing::TestWithParam<std::tuple<std::string, int, double>> {};

TEST_P(RivalsOrder, OnTheBanner) {
  const auto& [name, steps, order] = GetParam();
  const scene::Mesh mesh = sheet(10, 50);
  const Physics physics(mesh, banner_air);
  Walk truth(physics, Multistep::adams, 1e-13);
  truth.to(until);
  double error[2];
  for (int fine = 0; fine < 2; ++fine) {
    const int count = steps << fine;
    Options options;
    options.tolerance = 1e-12;
    options.iterations = name == "projective_dynamics" ? 300 : name == "xpbd" ? 40 : 0;
    const auto method = make_method(name, physics, until / count, options);
    for (int k = 0; k < count; ++k) method->advance();
    error[fine] = distance(method->positions(), truth.positions());
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), order, 0.2) << error[0] << " then " << error[1];
}

INSTANTIATE_TEST_SUITE_P(Of, RivalsOrder,
                         ::testing::Values(std::tuple("symplectic_euler", 80, 1.0),
                                           std::tuple("velocity_verlet", 80, 2.0), std::tuple("rk4", 40, 4.0),
                                           std::tuple("backward_euler", 80, 1.0), std::tuple("bdf2", 80, 2.0),
                                           std::tuple("linearly_implicit", 80, 1.0),
                                           std::tuple("xpbd", 80, 1.0),
                                           std::tuple("projective_dynamics", 80, 1.0)),
                         [](const auto& made) { return std::get<0>(made.param); });

} // namespace
} // namespace hopmesh::tests
