// An image's pull: towards its edge from both sides, by the slope of the edge's strength, and none outside.
#include "sim/levels/image_force.h"
#include "tests/support/files.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace levels;

/// Black on the left, white on the right of a picture of 41 x 21 pixels; the edge runs through column 20.
class ImageForceTest : public ::testing::Test {
 protected:
  ImageForceTest() {
    std::ofstream file(folder_ / "edge.pgm");
    file << "P2 41 21 2\n";
    for (int r = 0; r < 21; ++r)
      for (int c = 0; c < 41; ++c) file << (c < 20 ? 0 : c > 20 ? 2 : 1) << ' ';
    file.close();
    scene.force.image = scene::ImageSpec{folder_ / "edge.pgm", 0.5, 3, 2};
    scene.mesh.mass = 2;
  }

  /// At a pixel's place, y anywhere.
  std::vector<double> at(double column, double row) const {
    return ImageForce(scene).at({column * 0.5, 7, -row * 0.5});
  }

  scene::Scene scene;

 private:
  Folder folder_;
};

TEST_F(ImageForceTest, PullsToTheEdgeFromBothSides) {
  EXPECT_EQ(at(20, 10), (std::vector<double>{0, 0, 0}));
  EXPECT_GT(at(18, 10)[0], 0);
  EXPECT_EQ(at(22, 10)[0], -at(18, 10)[0]);
  EXPECT_EQ(at(18, 10)[1], 0);
  EXPECT_EQ(at(18, 10)[2], 0) << "along the edge nothing changes";
}

TEST_F(ImageForceTest, IsTheSlopeOfTheEdgesStrengthOverMassAndPitch) {
  // 16 times 1/2 1/2: smoothing 2 takes 8 passes of 1/4 1/2 1/4. The step 0, 1/2, 1 has slope 1/4, 1/2, 1/4
  // by central differences: one pass more.
  const auto bell = [](int k) { // the binomial coefficient 18 over 9 + k
    double value = 1;
    for (int i = 1; i <= 9 + k; ++i) value *= (18.0 - i + 1) / i;
    return value;
  };
  for (int k = -3; k <= 3; ++k) {
    const double slope = (bell(k + 1) - bell(k - 1)) / 2 / bell(0); // of the strength, a pixel
    EXPECT_NEAR(at(20 + k, 10)[0], 3 * slope / 0.5 / 2, 1e-12) << k;
  }
}

TEST_F(ImageForceTest, IsInProportionBetweenPixelsAndNothingOutside) {
  EXPECT_NEAR(at(17.25, 10.5)[0], 0.75 * at(17, 10)[0] + 0.25 * at(18, 10)[0], 1e-12);
  EXPECT_EQ(at(40.01, 10)[0], 0);
  EXPECT_EQ(at(20, -0.01)[0], 0);
  EXPECT_EQ(at(std::nan(""), 3)[0], 0);
}

} // namespace
} // namespace hopmesh::tests
