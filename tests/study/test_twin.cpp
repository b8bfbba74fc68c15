// What the last place of a start makes of a motion in double.
#include "sim/study/twin.h"
#include "tests/support/small_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace study;

class TwinTest : public ::testing::Test {
 protected:
  static scene::Inputs inputs_of(const std::string& scene, const std::vector<std::string>& overrides) {
    return scene::read_inputs(scene, "", overrides);
  }

  /// Distances after each step.
  static std::vector<double> apart(const scene::Inputs& inputs, std::uint64_t steps) {
    const levels::BuiltMesh mesh(inputs.scene);
    levels::ReferenceMover reference(inputs.scene, mesh, inputs.array);
    Twin twin(inputs.scene, mesh, inputs.array);
    const std::atomic<bool> stop{false};
    run::simulate(reference, steps, {&twin}, stop);
    return twin.apart();
  }
};

TEST_F(TwinTest, StartsALastPlaceApartAndIsTheSameAtEveryCall) {
  const auto inputs = inputs_of("banner", {"mesh.grid.rows=4", "mesh.grid.columns=5"});
  const std::vector<double> once = apart(inputs, 3);
  ASSERT_EQ(once.size(), 3u);
  EXPECT_GT(once[0], 0);
  EXPECT_LT(once[0], 1e-12) << "nothing has grown yet";
  EXPECT_EQ(once, apart(inputs, 3));
}

// The probe kicks every node to one side or the other: a flat flag forgets its start at once.
TEST_F(TwinTest, AFlagForgetsTheLastPlaceOfItsStart) {
  const std::vector<double> flag = apart(inputs_of("flag-225", {}), 20);
  EXPECT_GT(flag.front(), 1e-6) << "nothing but rounding says which way a flat flag leaves its plane";
  EXPECT_GT(flag.back(), 100 * flag.front());
}

TEST_F(TwinTest, LeavesAPlaneAPlane) {
  const auto inputs = inputs_of("two-nodes", {"mesh.planar=true"});
  const levels::BuiltMesh mesh(inputs.scene);
  levels::ReferenceMover reference(inputs.scene, mesh, inputs.array);
  EXPECT_LT(apart(inputs, 5).back(), 1e-9);
}

TEST_F(TwinTest, TellsNothingOfTimesThatItDidNotReach) {
  auto inputs = inputs_of("two-nodes", {"motion.steps=4"});
  const levels::BuiltMesh mesh(inputs.scene);
  const std::atomic<bool> stop{false};
  const double step = inputs.scene.motion.time_step;
  const auto at = sensitivity_of(inputs, mesh, {step, 4 * step, 5 * step}, stop);
  ASSERT_EQ(at.size(), 3u);
  EXPECT_TRUE(at[0] && at[1]);
  EXPECT_FALSE(at[2]);
  const std::vector<double> all = apart(inputs, 4);
  EXPECT_EQ(*at[0], all[0]);
  EXPECT_EQ(*at[1], all[3]);
}

} // namespace
} // namespace hopmesh::tests
