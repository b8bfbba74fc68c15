// The stiffest wave where a formula knows it.
#include "sim/scene/frequency.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

/// `free` nodes in a row behind a pinned one, springs of weight alpha between neighbours.
Mesh chain(std::uint32_t free, double alpha, double mass) {
  Mesh mesh;
  mesh.mass = mass;
  for (std::uint32_t i = 0; i <= free; ++i) {
    mesh.position.push_back({double(i), 0, 0});
    mesh.pinned.push_back(i == 0);
    if (i > 0) mesh.springs.push_back({{i - 1, i}, alpha, 1.0});
  }
  return mesh;
}

TEST(Frequency, OneSpringSwingsAtTheRootOfKOverM) {
  EXPECT_NEAR(largest_frequency(chain(1, 50, 0.25)), std::sqrt(2 * 50 / 0.25), 1e-9);
}

TEST(Frequency, AChainHasItsClosedForm) {
  for (std::uint32_t n : {2u, 5u, 12u}) {
    const double pi = std::acos(-1.0), k = 2 * 3.0, m = 0.5;
    const double omega = 2 * std::sqrt(k / m) * std::sin((2 * n - 1) * pi / (4 * n + 2));
    EXPECT_NEAR(largest_frequency(chain(n, 3, m)), omega, 1e-5 * omega) << n;
  }
}

// A constant tension T is soft along itself; across a length l it holds like a spring of T / l.
TEST(Frequency, ATensionSwingsAcrossItself) {
  Mesh mesh = chain(1, 50, 0.25);
  mesh.position[1][0] = 2;
  mesh.law = SpringLaw::tension;
  EXPECT_NEAR(largest_frequency(mesh), std::sqrt(50 / 2.0 / 0.25), 1e-9);
}

TEST(Frequency, APinnedMeshHasNone) {
  Mesh mesh = chain(1, 1, 1);
  mesh.pinned[1] = true;
  EXPECT_EQ(largest_frequency(mesh), 0);
}

} // namespace
} // namespace hopmesh::tests
