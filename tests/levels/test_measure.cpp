// Energy, strain and stretch of a state, by hand.
#include "sim/levels/mover.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

scene::Mesh three_in_a_row() {
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}};
  mesh.springs = {{{0, 1}, 1.0, 2.0}, {{1, 2}, 10.0, 0.0}};
  mesh.pinned = {true, false, false};
  mesh.mass = 4;
  return mesh;
}

TEST(Measure, ByHand) {
  const double x[] = {0, 0, 0, 3, 0, 4, 3, 0, 10}; // springs of length 5 and 6
  const double v[] = {0, 0, 0, 1, 2, 2, 0, 0, -3}; // squares 9 and 9
  levels::StepRow row;
  levels::measure(three_in_a_row(), x, v, row);
  EXPECT_DOUBLE_EQ(row.energy, 1 * 3 * 3 + 10 * 6 * 6);
  EXPECT_DOUBLE_EQ(row.kinetic, 0.5 * 4 * (9 + 9));
  EXPECT_DOUBLE_EQ(row.max_strain, 1.5);  // 5 / 2 - 1; a spring without rest length has no strain
  EXPECT_DOUBLE_EQ(row.max_stretch, 2.5); // 5 / 2 against 6 / 3 as built
}

TEST(Measure, CompressionIsStrainButNoStretch) {
  const double x[] = {0, 0, 0, 0.5, 0, 0, 0.5, 3, 0}, v[9] = {};
  levels::StepRow row;
  levels::measure(three_in_a_row(), x, v, row);
  EXPECT_DOUBLE_EQ(row.max_strain, 0.75);
  EXPECT_DOUBLE_EQ(row.max_stretch, 1.0); // of the other spring
  EXPECT_DOUBLE_EQ(row.kinetic, 0);
}

TEST(Measure, ForgetsTheStepBefore) {
  levels::StepRow row;
  row.energy = row.kinetic = row.max_strain = row.max_stretch = 1e9;
  const double x[] = {0, 0, 0, 2, 0, 0, 2, 3, 0}, v[9] = {};
  levels::measure(three_in_a_row(), x, v, row);
  EXPECT_DOUBLE_EQ(row.energy, 90);
  EXPECT_DOUBLE_EQ(row.max_strain, 0);
  EXPECT_DOUBLE_EQ(row.max_stretch, 1);
}

} // namespace
} // namespace hopmesh::tests
