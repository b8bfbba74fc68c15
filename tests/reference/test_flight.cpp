// Whole meshes in motion: what must hold over many steps of docs/method/theory.md, section 4.
#include "sim/reference/reference.h"
#include "tests/reference/flags.h"
#include "tests/reference/random_inputs.h"
#include "tests/reference/vectors.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

TEST(ReferenceFlight, FreeFallIsExact) {
  // gamma = 0 takes the springs' kicks away, dyadic numbers the rounding: v = k dt f, x = x0 + dt^2 f k (k -
  // 1) / 2.
  scene::Mesh mesh = flag(3, 4);
  mesh.pinned.assign(mesh.nodes(), false);
  StepParameters motion = flying();
  motion.gamma = 0;
  motion.friction = 1;
  motion.time_step = 0.0625;
  motion.force = {0.5, -0.25, -1};
  State state = initial_state(mesh);
  const State start = state;
  for (int k = 1; k <= 32; ++k) {
    advance(mesh, motion, one_by_one(state.V.size()), state);
    for (std::size_t n = 0; n < mesh.nodes(); ++n) {
      ASSERT_EQ(at(state.velocity, n), Eigen::Vector3d(k * 0.0625 * motion.force));
      const double fallen = 0.0625 * 0.0625 * k * (k - 1) / 2;
      ASSERT_EQ(at(state.position, n), Eigen::Vector3d(at(start.position, n) + fallen * motion.force));
    }
  }
}

TEST(ReferenceFlight, ForceOnTheAccelerationActsOneStepLater) {
  // gamma = 0, memory 1, no friction: a = f after the first step, so x stands still in it and v too.
  scene::Mesh mesh = flag(2, 2);
  StepParameters motion = flying();
  motion.gamma = 0;
  motion.friction = 1;
  motion.time_step = 0.5;
  motion.acceleration_memory = 1;
  motion.force_on_acceleration = true;
  motion.force = {0, 0, -2};
  State state = initial_state(mesh);
  const double expected[][3] = {{-1, 0, -2}, {-1.25, -1, -4}, {-2.25, -3, -6}}; // z, v, a of node 3
  for (const auto& [z, v, a] : expected) {
    advance(mesh, motion, one_by_one(state.V.size()), state);
    EXPECT_EQ(state.position[11], z);
    EXPECT_EQ(state.velocity[11], v);
    EXPECT_EQ(state.acceleration[11], a);
  }
}

TEST(ReferenceFlight, PinnedNodesNeverMoveAndFreeOnesDo) {
  const scene::Mesh mesh = flag(4, 5);
  const StepParameters motion = flying();
  State state = initial_state(mesh);
  const State start = state;
  for (int k = 0; k < 20; ++k) advance(mesh, motion, one_by_one(state.V.size()), state);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    EXPECT_EQ(at(state.position, n) == at(start.position, n), bool(mesh.pinned[n])) << n;
    EXPECT_EQ(at(state.velocity, n).norm() == 0, bool(mesh.pinned[n])) << n;
  }
}

TEST(ReferenceFlight, EveryNodeMovesByTheOldStateOfTheOthers) {
  // Renumbering the nodes of a symmetric mesh must mirror the motion: an update that ran into itself would
  // not.
  scene::Mesh mesh;
  mesh.position = {{-1.5, 0, 0}, {0, 0, 0}, {1.5, 0, 0}};
  mesh.pinned = {false, true, false};
  mesh.springs = {{{0, 1}, 1, 1}, {{0, 2}, 1, 2}, {{1, 2}, 1, 1}};
  StepParameters motion = flying();
  motion.force.setZero();
  motion.threshold = 1e-12;
  motion.max_sweeps = 20000;
  State state = initial_state(mesh);
  state.V << 1, 0, 0, 0, 0, 0, -1, 0, 0;
  state.step = 1;
  Order together = {{0, 6}, {1, 7}, {2, 8}}; // mirrored neurons fire in the same phase
  for (int k = 0; k < 10; ++k) {
    advance(mesh, motion, together, state);
    ASSERT_EQ(state.position[0], -state.position[6]) << "step " << k;
    ASSERT_EQ(state.velocity[0], -state.velocity[6]) << "step " << k;
  }
  EXPECT_NE(state.position[0], -1.5);
}

TEST(ReferenceFlight, ASecondExpansionIsTheFirstOnesRestExpandedAgain) {
  Random random(43);
  for (int k = 0; k < 20; ++k) {
    const scene::Mesh mesh = random_mesh(random, 8, k % 2 == 1);
    StepParameters once = random_motion(random);
    once.time_step = 1; // the expansion point matters
    StepParameters twice = once;
    twice.expansions = 2;
    const State start = random_state(random, mesh);
    const Order order = one_by_one(start.V.size());
    State state = start;
    const Relaxation first = advance(mesh, once, order, state).relaxation;
    state = start;
    const Step step = advance(mesh, twice, order, state);
    const Network about_rest = network(mesh, twice, step.predicted, first.V);
    const Relaxation second = relax(about_rest, order, first.V, twice.threshold, twice.max_sweeps);
    ASSERT_EQ(step.V0, first.V);
    ASSERT_EQ(step.relaxation.V, second.V);
    ASSERT_EQ(step.relaxation.sweeps, first.sweeps + second.sweeps);
    ASSERT_EQ(step.relaxation.converged, second.converged);
    ASSERT_EQ(Eigen::MatrixXd(step.network.W), Eigen::MatrixXd(about_rest.W));
    ASSERT_NE(first.V, second.V) << "mesh " << k;
  }
}

TEST(ReferenceFlight, APlanarMeshMovesAsTheSameMeshInSpace) {
  scene::Mesh flat = flag(4, 4), in_space = flat;
  flat.planar = true;
  StepParameters motion = flying();
  motion.force = {0.3, 0, -0.1};
  State two = initial_state(flat), three = initial_state(in_space);
  for (int k = 0; k < 40; ++k) {
    advance(flat, motion, one_by_one(two.V.size()), two);
    advance(in_space, motion, one_by_one(three.V.size()), three);
    ASSERT_LT((two.position - three.position).cwiseAbs().maxCoeff(), 1e-10) << "step " << k;
  }
}

TEST(ReferenceFlight, InAPlanarMeshYNeverMoves) {
  Random random(44);
  const scene::Mesh mesh = random_mesh(random, 9, true);
  const StepParameters motion = random_motion(random);
  State state = initial_state(mesh);
  const State start = state;
  ASSERT_NE(motion.force.y(), 0);
  for (int k = 0; k < 5; ++k) advance(mesh, motion, one_by_one(state.V.size()), state);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) EXPECT_EQ(state.position[3 * n + 1], 0.25);
  EXPECT_NE(state.position, start.position);
}

TEST(ReferenceFlight, TheProbeKicksAMeshThatIsAtRest) {
  // Its noise floor: every spring has its natural length and nothing pulls, but a unit probe costs energy
  // and sqrt(gamma dE) turns that into a kick.
  const scene::Mesh mesh = flag(3, 3);
  StepParameters motion = flying();
  motion.force.setZero();
  State state = initial_state(mesh);
  EXPECT_NEAR(spring_energy(mesh, state.position), 0, 1e-30);
  advance(mesh, motion, one_by_one(state.V.size()), state);
  EXPECT_GT(state.velocity.norm(), 1e-3);
}

TEST(ReferenceFlight, AFlagFliesWithThePapersSettings) {
  // Bounded for 100 steps with memory 0; with the paper's literal eq. 7 (memory 1, force on a) it falls
  // apart.
  const scene::Mesh mesh = flag(8, 8);
  const auto largest_strain = [&](StepParameters motion) {
    State state = initial_state(mesh);
    const Order order = one_by_one(state.V.size());
    double largest = 0;
    for (int k = 0; k < 100 && largest < 100; ++k) {
      advance(mesh, motion, order, state);
      for (const auto& spring : mesh.springs) {
        const double length =
            (at(state.position, spring.node[0]) - at(state.position, spring.node[1])).norm();
        largest = std::max(largest, std::abs(length / spring.rest_length - 1));
      }
    }
    return largest;
  };
  StepParameters literal = flying();
  literal.acceleration_memory = 1;
  literal.force_on_acceleration = true;
  const double memoryless = largest_strain(flying());
  EXPECT_LT(memoryless, 0.3);
  EXPECT_GT(memoryless, 0.001);
  EXPECT_GT(largest_strain(literal), 1);
}

} // namespace
} // namespace hopmesh::tests
