// The exact motion of a scene: a closed form, and what of a scene nobody can compute.
#include "sim/levels/exact_motion.h"
#include "tests/support/complaint.h"
#include "tests/support/small_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

std::string refusal(const scene::Scene& scene) {
  return complaint([&] { levels::exact_surroundings(scene); });
}

// A free part falls as one, slowed by drag alone: v = g/c (1 - exp(-ct)).
TEST(ExactMotion, OfAFallIsTheClosedForm) {
  scene::Scene scene = grid_scene(2, 2);
  scene.mesh.pinned.clear();
  scene.motion.friction = 1; // anything less is a drag of its own
  scene.force = {};
  scene.force.gravity = {0, 0, -9.81};
  scene.force.drag = 0.5;
  const levels::BuiltMesh mesh(scene);
  const levels::ExactMotion exact = levels::exact_motion(scene, mesh, {0.5, 2});
  ASSERT_EQ(exact.positions.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const double t = k == 0 ? 0.5 : 2, fall = 9.81 / 0.5 * (t - (1 - std::exp(-0.5 * t)) / 0.5);
    EXPECT_NEAR(exact.positions[k][2], mesh.mesh().position[0][2] - fall, 1e-8);
    EXPECT_LT(exact.floor[k], 1e-8);
  }
}

// Rivals and the truth walk through time, which a static scene has none of.
TEST(ExactMotion, RefusesAStaticScene) {
  scene::Scene scene;
  EXPECT_EQ(refusal(scene), "");
  scene.incremental.rule = scene::Rule::statics;
  EXPECT_EQ(refusal(scene), "") << "the rule of a formulation that is not the scene's";
  scene.motion.formulation = scene::Formulation::incremental;
  EXPECT_EQ(refusal(scene), "incremental.rule: found \"static\", expected a motion (backward_euler or bdf2) "
                            "for rivals and truth, which walk through time");
}

TEST(ExactMotion, RefusesWhatRivalsDoNotKnow) {
  scene::Scene pulled, looking, stopped;
  pulled.mesh.law = scene::SpringLaw::tension;
  EXPECT_EQ(refusal(pulled),
            "mesh.springs.law: found \"tension\", expected \"linear\": rivals and truth know "
            "no other springs");
  looking.force.image.emplace();
  EXPECT_EQ(refusal(looking),
            "force.image.file: found an image, expected none: rivals and truth do not look at it");
  stopped.motion.friction = 0;
  EXPECT_EQ(refusal(stopped), "motion.friction: found 0, expected above 0 for a method with a drag");
}

} // namespace
} // namespace hopmesh::tests
