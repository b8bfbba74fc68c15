// Where a scene lets its rivals stop early, the step that the array is held against is still the exact one.
#include "sim/levels/exact_step.h"
#include "tests/support/small_scenes.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

scene::Scene swinging(double tolerance) {
  scene::Scene scene = grid_scene(5, 5);
  scene.motion.formulation = scene::Formulation::incremental;
  scene.motion.friction = 0.9;
  scene.force.gravity = {9.81, 1, -3};
  scene.rival.tolerance = tolerance;
  return scene;
}

template <class Motion> std::vector<double> after(int steps, Motion&& motion) {
  for (int k = 0; k < steps; ++k) motion.advance();
  return motion.positions();
}

TEST(ExactStep, IsExactWhateverTheSceneLetsItsRivalsDo) {
  const scene::Scene scene = swinging(0), lax = swinging(10);
  const levels::BuiltMesh mesh(scene);
  EXPECT_EQ(after(4, levels::ExactStep(lax, mesh)), after(4, levels::ExactStep(scene, mesh)));
  EXPECT_NE(after(4, levels::RivalMover("backward_euler", lax, mesh)),
            after(4, levels::RivalMover("backward_euler", scene, mesh)));
}

} // namespace
} // namespace hopmesh::tests
