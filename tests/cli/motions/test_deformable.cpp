// Deformable meshes from OBJ files (docs/findings/cloth-and-solids.md): each shipped scene against a Newton
// solver that shares nothing with the array, against the balance of forces at rest, and level against level.
#include "place.h"

#include "sim/scene/mesh.h"
#include "sim/scene/scene_file.h"
#include "tests/cli/motions/scene_motion.h"

namespace hopmesh::tests {
namespace {

scene::Mesh mesh_of(const std::string& name) {
  return scene::build_mesh(scene::read_inputs(name, "", {}).scene);
}

double free_weight(const scene::Mesh& mesh) {
  const auto free = std::count(mesh.pinned.begin(), mesh.pinned.end(), false);
  return static_cast<double>(free) * mesh.mass * 9.81;
}

/// What the springs pull the pins down with, N, with the nodes where a run's last step left them.
double load_of_pins(const scene::Mesh& mesh, const Positions& p) {
  double load = 0;
  for (const scene::Spring& s : mesh.springs) {
    if (mesh.pinned[s.node[0]] == mesh.pinned[s.node[1]]) continue;
    const std::size_t pin = s.node[mesh.pinned[s.node[0]] ? 0 : 1], other = s.node[0] + s.node[1] - pin;
    double d[3];
    for (std::size_t a = 0; a < 3; ++a) d[a] = p.at(p.steps(), other, a) - p.at(p.steps(), pin, a);
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    load -= 2 * s.weight * (length - s.rest_length) * d[2] / length;
  }
  return load;
}

class Deformable : public SceneMotion {
 protected:
  /// The array follows Newton's solution far more closely than that follows the true motion.
  void expect_step_of_newton(const std::string& scene, std::size_t step, double exact_bound, double share) {
    const std::string steps = " --steps " + std::to_string(step);
    const Positions newton = positions(scene + steps + " --level backward_euler");
    const Positions truth =
        positions(scene + " --level rk4 --set motion.time_step=0.0005 --steps " + std::to_string(20 * step));
    const double own = distance(newton, truth, step, 20 * step);
    EXPECT_LT(distance(positions(scene + steps), newton, step), share * own) << "of " << own << " m";
    const Positions exactly = positions(scene + steps +
                                        " --level reference --set relax.threshold=1e-12 "
                                        "--set relax.max_sweeps=100000 --set relax.expansions=30");
    EXPECT_LT(distance(exactly, newton, step), exact_bound);
  }
};

TEST_F(Deformable, ABlockIsCaughtAsNewtonCatchesIt) {
  expect_step_of_newton("soft-block", 10, 1e-7, 0.1);
}

// Longer than this a flat cloth's folds grow from differences of any size.
TEST_F(Deformable, AClothFallsAsNewtonLetsItFall) {
  expect_step_of_newton("tablecloth", 10, 1e-6, 0.05);
}

TEST_F(Deformable, PinsCarryTheClothThatHangs) {
  const scene::Mesh mesh = mesh_of("tablecloth");
  EXPECT_EQ(std::count(mesh.pinned.begin(), mesh.pinned.end(), true), 137)
      << "lattice points of i^2 + j^2 <= 44";
  const Positions hanging = positions("tablecloth --steps 800 --set force.drag=8");
  EXPECT_NEAR(load_of_pins(mesh, hanging), free_weight(mesh), 0.005 * free_weight(mesh));
  for (std::size_t i = 0; i < mesh.nodes(); ++i) EXPECT_LT(hanging.at(800, i, 2), 0.05) << "above the table";
}

// Rest by two ways: the array's static steps, Newton's motion through thick air.
TEST_F(Deformable, ABlockAtRestIsTheSameByEitherWay) {
  const scene::Mesh mesh = mesh_of("soft-block");
  const Positions still = positions("soft-block --steps 12 --set incremental.rule=static "
                                    "--set mesh.start.velocity=[0.0,0.0,0.0]");
  EXPECT_NEAR(load_of_pins(mesh, still), free_weight(mesh), 1e-6 * free_weight(mesh));
  const Positions moved = positions("soft-block --level backward_euler --steps 120 --set force.drag=8 "
                                    "--set motion.time_step=0.05");
  EXPECT_LT(distance(still, moved, 12, 120), 1e-4);
  EXPECT_GT(distance(still, still, 12, 0), 1e-2) << "it sagged";
}

TEST_F(Deformable, ThePagesPicturesAreWhatTheRunsLeave) {
  for (const std::string scene : {"tablecloth", "soft-block"})
    EXPECT_TRUE(content_of(results_of(scene + " --no-check", scene) / "picture.svg") ==
                content_of(HOPMESH_SOURCE_DIR "/docs/pictures/" + scene + ".svg"))
        << scene;
}

TEST_F(Deformable, LevelsAgreeToTheBit) {
  expect_equal_levels("tablecloth --steps 3");
  expect_equal_levels("soft-block --steps 5");
}

} // namespace
} // namespace hopmesh::tests
