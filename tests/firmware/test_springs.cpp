// Lengths and energies of springs, by hand.
#include "tests/support/firmware_mesh.h"

extern "C" {
#include "firmware/springs.h"
}

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// A corner held at one end: a spring of length 5 and rest length 3 to node 1, one of length 12 and rest
/// length 12 on to node 2.
struct Corner : FirmwareMesh {
  explicit Corner(double rest = 3)
      : FirmwareMesh({{0, 1, 2, rest}, {1, 2, 7, 4 * rest}}, {true, false, false}, 3) {}
  const double position[9] = {1, 1, 1, 4, 5, 1, 4, 5, 13};
};

TEST(Springs, EnergyIsTheSquareOfTheStretch) {
  const Corner c;
  EXPECT_EQ(hm_one_spring_energy(&c.mesh, &c.mesh.spring[0], c.position, c.position + 3), 2 * 2 * 2);
  EXPECT_EQ(hm_spring_energy(&c.mesh, c.position), 8);
}

TEST(Springs, UnderTensionEnergyIsThePullTimesTheSmoothedLength) {
  Corner c(0);
  c.mesh.law = HM_TENSION;
  c.mesh.floor = 12;
  EXPECT_EQ(hm_one_spring_energy(&c.mesh, &c.mesh.spring[0], c.position, c.position + 3), 2 * 13);
  c.mesh.floor = 5;
  EXPECT_EQ(hm_one_spring_energy(&c.mesh, &c.mesh.spring[1], c.position + 3, c.position + 6), 7 * 13);
  c.mesh.floor = 1e-30; // a spring of no length still has its pull's direction
  EXPECT_EQ(hm_one_spring_energy(&c.mesh, &c.mesh.spring[0], c.position, c.position), 2e-30);
}

TEST(Springs, TheLongestIsFoundWhereverItIs) {
  const Corner c;
  EXPECT_EQ(hm_longest_spring(&c.mesh, c.position), 12);
  const double folded[9] = {0, 0, 0, 0, 0, 20, 0, 0, 20};
  EXPECT_EQ(hm_longest_spring(&c.mesh, folded), 20);
}

TEST(Springs, OnlyLinearOnesWithoutRestLengthAreQuadratic) {
  const Corner resting(3);
  EXPECT_FALSE(hm_springs_are_quadratic(&resting.mesh));
  Corner c(0);
  EXPECT_TRUE(hm_springs_are_quadratic(&c.mesh));
  c.mesh.spring[1].rest_length = 1;
  EXPECT_FALSE(hm_springs_are_quadratic(&c.mesh));
  c.mesh.spring[1].rest_length = 0;
  c.mesh.law = HM_TENSION;
  EXPECT_FALSE(hm_springs_are_quadratic(&c.mesh));
}

} // namespace
} // namespace hopmesh::tests
