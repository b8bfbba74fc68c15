// One step of the probe formulation: docs/theory.md, section 4.
#include "sim/reference/reference.h"
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::reference::testing {
namespace {

Eigen::Vector3d at(const Vector& all, std::size_t node) {
  return all.segment<3>(3 * node);
}

Eigen::Vector3d output(const scene::Mesh& mesh, const Vector& V, std::size_t node) {
  if (mesh.planar) return {V[2 * node], 0, V[2 * node + 1]};
  return at(V, node);
}

/// Node 1 two below the pin on a spring of length 1, dt = 1 so that h = 1/2; friction 1/2; one sweep a step.
struct Hanging {
  scene::Mesh mesh;
  Motion motion{};
  Hanging() {
    mesh.position = {{0, 0, 0}, {0, 0, -2}};
    mesh.pinned = {true, false};
    mesh.springs = {{{0, 1}, 1, 1}};
    motion.time_step = 1;
    motion.friction = 0.5;
    motion.gamma = 4;
    motion.beta = 1;
    motion.max_sweeps = 1;
    motion.expansions = 1;
    motion.force.setZero();
  }
};

/// A flag hanging by its left column: rows x columns, unit pitch, structural springs and both diagonals.
scene::Mesh flag(std::uint32_t rows, std::uint32_t columns) {
  scene::Mesh mesh;
  const auto join = [&](std::uint32_t i, std::uint32_t j, double length) {
    mesh.springs.push_back({{std::min(i, j), std::max(i, j)}, 1, length});
  };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t n = r * columns + c;
      mesh.position.push_back({double(c), 0, -double(r)});
      mesh.pinned.push_back(c == 0);
      if (c > 0) join(n - 1, n, 1);
      if (r > 0) join(n - columns, n, 1);
      if (r > 0 && c > 0) join(n - columns - 1, n, std::sqrt(2.0));
      if (r > 0 && c > 0) join(n - columns, n - 1, std::sqrt(2.0));
    }
  return mesh;
}

/// The settings of the paper's flags.
Motion flying() {
  Motion motion{};
  motion.time_step = 0.05;
  motion.friction = 0.99;
  motion.gamma = 4000;
  motion.beta = 1;
  motion.force = {0.3, 0.1, -0.1};
  motion.threshold = 1e-4;
  motion.max_sweeps = 300;
  motion.expansions = 1;
  return motion;
}

TEST(ReferenceMotion, IsReadFromTheScene) {
  scene::Scene scene;
  scene.motion = {scene::Formulation::probe, 0.25, 10, 0.75};
  scene.probe = {11, 12, 0.5, "all", "acceleration"};
  scene.relax = {1e-3, 77, 3};
  scene.force = {{1, 2, 3}, scene::Vector3{10, 20, 30}};
  Motion motion = motion_of(scene);
  EXPECT_EQ(motion.time_step, 0.25);
  EXPECT_EQ(motion.friction, 0.75);
  EXPECT_EQ(motion.gamma, 11);
  EXPECT_EQ(motion.beta, 12);
  EXPECT_EQ(motion.acceleration_memory, 0.5);
  EXPECT_TRUE(motion.energy_of_all_springs);
  EXPECT_TRUE(motion.force_on_acceleration);
  EXPECT_EQ(motion.force, Eigen::Vector3d(11, 22, 33));
  EXPECT_EQ(motion.threshold, 1e-3);
  EXPECT_EQ(motion.max_sweeps, 77u);
  EXPECT_EQ(motion.expansions, 3u);
  scene.force.wind.reset();
  scene.probe.energy_springs = "own";
  scene.probe.force_on = "velocity";
  motion = motion_of(scene);
  EXPECT_EQ(motion.force, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(motion.energy_of_all_springs);
  EXPECT_FALSE(motion.force_on_acceleration);
}

TEST(ReferenceMotion, PredictionKeepsTheRememberedShareOfTheAcceleration) {
  // dt = 1/2, h = 1/8, memory 1/2: 1 + 2/2 + 16/16 = 3.
  Hanging hanging;
  hanging.motion.time_step = 0.5;
  hanging.motion.acceleration_memory = 0.5;
  State state = initial_state(hanging.mesh);
  for (int node = 0; node < 2; ++node) {
    state.position.segment<3>(3 * node).setConstant(1);
    state.velocity.segment<3>(3 * node).setConstant(2);
    state.acceleration.segment<3>(3 * node).setConstant(16);
  }
  const Vector C = predict(hanging.mesh, hanging.motion, state);
  EXPECT_EQ(at(C, 1), Eigen::Vector3d::Constant(3));
  EXPECT_EQ(at(C, 0), Eigen::Vector3d::Constant(1)); // pinned: x, whatever v and a say
}

TEST(ReferenceMotion, ExpansionPointIsThePreviousRestAtUnitLength) {
  scene::Mesh mesh = flag(1, 4); // node 0 pinned
  State state = initial_state(mesh);
  state.V << 9, 9, 9, 0.3, 0, -0.4, 0, 5e-10, 0, 0, 0, 0;
  state.step = 1;
  Vector expected(12);
  expected << 0, 0, 0, 0.6, 0, -0.8, 0, 0, -1, 0, 0, -1;
  EXPECT_TRUE(expansion_point(mesh, state).isApprox(expected, 1e-15));
  state.step = 0; // nothing has come to rest yet
  expected.segment<3>(3) << 0, 0, -1;
  EXPECT_EQ(expansion_point(mesh, state), expected);
  mesh.planar = true;
  state = initial_state(mesh);
  Vector planar(8);
  planar << 0, 0, 0, -1, 0, -1, 0, -1;
  EXPECT_EQ(expansion_point(mesh, state), planar);
}

TEST(ReferenceMotion, OneStepOfTwoNodesByHand) {
  // The network of ReferenceNetwork.OfOneSpringByHand: only z moves. s = 5/2 - 1 = 3/2, N = 5/2 + 1 = 7/2, u
  // = 3/7, R = 2: V = -1 + 6/7 = -1/7, so the direction is still down. At C + h dahat the spring is 5/2 long:
  // dE = (3/2)^2 - 1^2 = 5/4, a = -sqrt(4 * 5/4) = -sqrt 5.
  Hanging hanging;
  State state = initial_state(hanging.mesh);
  const Step step = advance(hanging.mesh, hanging.motion, one_by_one(6), state);
  const double a = -std::sqrt(5.0);
  EXPECT_DOUBLE_EQ(step.relaxation.V[5], -1.0 / 7);
  EXPECT_EQ(step.relaxation.sweeps, 1u);
  EXPECT_DOUBLE_EQ(state.acceleration[5], a);
  EXPECT_DOUBLE_EQ(state.position[5], -2 + 0.5 * a);
  EXPECT_DOUBLE_EQ(state.velocity[5], 0.5 * a);
  EXPECT_EQ(at(state.position, 0), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(state.position.segment<2>(3), Eigen::Vector2d(0, 0));
  EXPECT_EQ(state.step, 1u);
  EXPECT_EQ(state.V, step.relaxation.V);
}

TEST(ReferenceMotion, UpdateOrderByHand) {
  // Whatever direction d and change dE the probe finds (both are read back), from x = -2, v = 1/4, a = 8,
  // memory 1/2: a first, x with the old v and the new a, v with the new a, friction, then the force.
  for (const bool on_acceleration : {false, true}) {
    Hanging hanging;
    hanging.motion.acceleration_memory = 0.5;
    hanging.motion.force_on_acceleration = on_acceleration;
    hanging.motion.force = {0, 0, -3};
    State state = initial_state(hanging.mesh);
    state.velocity[5] = 0.25;
    state.acceleration[5] = 8;
    const Step step = advance(hanging.mesh, hanging.motion, one_by_one(6), state);
    const double C = -2 + 0.25 + 0.5 * 0.5 * 8; // 1/4
    ASSERT_EQ(step.predicted[5], C);
    const double d = step.relaxation.V[5] < 0 ? -1 : 1;
    const double length = std::abs(C + 0.5 * d), dE = (length - 1) * (length - 1) - 1;
    const double a = 4 + d * std::sqrt(std::abs(4 * dE));
    EXPECT_DOUBLE_EQ(state.position[5], -2 + 0.25 + 0.5 * a);
    EXPECT_DOUBLE_EQ(state.velocity[5], (0.25 + a) * 0.5 + (on_acceleration ? 0 : -3));
    EXPECT_DOUBLE_EQ(state.acceleration[5], a + (on_acceleration ? -3 : 0));
  }
}

// Delta E_i of docs/theory.md, section 4, with every spring asked whether it belongs.
double brute_energy_change(const scene::Mesh& mesh, const Motion& motion, const Vector& x, const Step& step,
                           std::size_t i) {
  const Wide h = Wide(motion.time_step) * motion.time_step / 2;
  WideVector only_i(step.relaxation.V.size(), 0);
  const double length = output(mesh, step.relaxation.V, i).norm();
  const Eigen::Index k = components(mesh);
  for (Eigen::Index p = 0; p < k; ++p) only_i[k * i + p] = Wide(step.relaxation.V[k * i + p]) / length;
  const WideVector nobody(only_i.size(), 0);
  Wide change = 0;
  for (const auto& spring : mesh.springs) {
    const auto [a, b] = spring.node;
    if (!motion.energy_of_all_springs && a != i && b != i) continue;
    change += plain_spring(spring, place(mesh, h, step.predicted, only_i, a),
                           place(mesh, h, step.predicted, only_i, b));
    change -= plain_spring(spring, place(mesh, h, x, nobody, a), place(mesh, h, x, nobody, b));
  }
  return static_cast<double>(change);
}

// With memory 0, |a|^2 = gamma |dE| right after the step: what the step took for dE can be read back.
void expect_brute_energy_changes(bool all, std::uint64_t seed) {
  Random random(seed);
  for (int k = 0; k < 60; ++k) {
    const scene::Mesh mesh = random_mesh(random, 5 + random.below(6), k % 2 == 1);
    Motion motion = random_motion(random);
    motion.energy_of_all_springs = all;
    motion.force_on_acceleration = false;
    motion.acceleration_memory = 0;
    State state = random_state(random, mesh);
    const State before = state;
    const Step step = advance(mesh, motion, one_by_one(state.V.size()), state);
    const double whole = spring_energy(mesh, before.position);
    for (std::size_t i = 0; i < mesh.nodes(); ++i) {
      if (mesh.pinned[i]) continue;
      const double expected =
          motion.gamma * std::abs(brute_energy_change(mesh, motion, before.position, step, i));
      const Eigen::Vector3d a = at(state.acceleration, i);
      // A difference of energies keeps the digits of the energies.
      ASSERT_NEAR(a.squaredNorm(), expected, 1e-12 * motion.gamma * whole) << "mesh " << k << " node " << i;
      const Eigen::Vector3d direction = output(mesh, step.relaxation.V, i).normalized();
      ASSERT_NEAR((a - direction * a.norm()).norm(), 0, 1e-12 * (1 + a.norm()))
          << "mesh " << k << " node " << i;
    }
  }
}

TEST(ReferenceMotion, EnergyChangeOfTheNodesOwnSpringsByBruteForce) {
  expect_brute_energy_changes(false, 41);
}

TEST(ReferenceMotion, EnergyChangeOfAllSpringsByBruteForce) {
  expect_brute_energy_changes(true, 42);
}

TEST(ReferenceMotion, ANodeWithoutDirectionGetsNoKick) {
  // From z = -1 at speed 1 the node arrives at the pin, where its spring has no length: C = 0. Then I = 0 and
  // u = -V: each sweep squares |V|, so that after eight nothing is left of (0.6, 0, -0.8). The energy does
  // change, by -1.
  Hanging hanging;
  hanging.mesh.position[1] = {0, 0, -1};
  hanging.mesh.springs[0].rest_length = 0;
  hanging.motion.beta = 0;
  hanging.motion.max_sweeps = 8;
  hanging.motion.acceleration_memory = 0.5;
  State state = initial_state(hanging.mesh);
  state.velocity[5] = 0.75;
  state.acceleration[5] = 1; // C = -1 + 3/4 + 1/2 * 1/2 * 1 = 0
  state.V << 0, 0, 0, 0.6, 0, -0.8;
  state.step = 1;
  const Step step = advance(hanging.mesh, hanging.motion, one_by_one(6), state);
  ASSERT_EQ(step.predicted[5], 0);
  ASSERT_LT(step.relaxation.V.norm(), 1e-9);
  EXPECT_EQ(at(state.acceleration, 1), Eigen::Vector3d(0, 0, 0.5));
}

TEST(ReferenceMotion, FreeFallIsExact) {
  // gamma = 0 takes the springs' kicks away, dyadic numbers the rounding: v = k dt f, x = x0 + dt^2 f k (k -
  // 1) / 2.
  scene::Mesh mesh = flag(3, 4);
  mesh.pinned.assign(mesh.nodes(), false);
  Motion motion = flying();
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

TEST(ReferenceMotion, ForceOnTheAccelerationActsOneStepLater) {
  // gamma = 0, memory 1, no friction: a = f after the first step, so x stands still in it and v too.
  scene::Mesh mesh = flag(2, 2);
  Motion motion = flying();
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

TEST(ReferenceMotion, PinnedNodesNeverMoveAndFreeOnesDo) {
  const scene::Mesh mesh = flag(4, 5);
  const Motion motion = flying();
  State state = initial_state(mesh);
  const State start = state;
  for (int k = 0; k < 20; ++k) advance(mesh, motion, one_by_one(state.V.size()), state);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    EXPECT_EQ(at(state.position, n) == at(start.position, n), bool(mesh.pinned[n])) << n;
    EXPECT_EQ(at(state.velocity, n).norm() == 0, bool(mesh.pinned[n])) << n;
  }
}

TEST(ReferenceMotion, EveryNodeMovesByTheOldStateOfTheOthers) {
  // Renumbering the nodes of a symmetric mesh must mirror the motion: an update that ran into itself would
  // not.
  scene::Mesh mesh;
  mesh.position = {{-1.5, 0, 0}, {0, 0, 0}, {1.5, 0, 0}};
  mesh.pinned = {false, true, false};
  mesh.springs = {{{0, 1}, 1, 1}, {{0, 2}, 1, 2}, {{1, 2}, 1, 1}};
  Motion motion = flying();
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

TEST(ReferenceMotion, ASecondExpansionIsTheFirstOnesRestExpandedAgain) {
  Random random(43);
  for (int k = 0; k < 20; ++k) {
    const scene::Mesh mesh = random_mesh(random, 8, k % 2 == 1);
    Motion once = random_motion(random);
    once.time_step = 1; // the expansion point matters
    Motion twice = once;
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

TEST(ReferenceMotion, APlanarMeshMovesAsTheSameMeshInSpace) {
  scene::Mesh flat = flag(4, 4), in_space = flat;
  flat.planar = true;
  Motion motion = flying();
  motion.force = {0.3, 0, -0.1};
  State two = initial_state(flat), three = initial_state(in_space);
  for (int k = 0; k < 40; ++k) {
    advance(flat, motion, one_by_one(two.V.size()), two);
    advance(in_space, motion, one_by_one(three.V.size()), three);
    ASSERT_LT((two.position - three.position).cwiseAbs().maxCoeff(), 1e-10) << "step " << k;
  }
}

TEST(ReferenceMotion, InAPlanarMeshYNeverMoves) {
  Random random(44);
  const scene::Mesh mesh = random_mesh(random, 9, true);
  const Motion motion = random_motion(random);
  State state = initial_state(mesh);
  const State start = state;
  ASSERT_NE(motion.force.y(), 0);
  for (int k = 0; k < 5; ++k) advance(mesh, motion, one_by_one(state.V.size()), state);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) EXPECT_EQ(state.position[3 * n + 1], 0.25);
  EXPECT_NE(state.position, start.position);
}

TEST(ReferenceMotion, TheProbeKicksAMeshThatIsAtRest) {
  // Its noise floor: every spring has its natural length and nothing pulls, but a unit probe costs energy
  // and sqrt(gamma dE) turns that into a kick.
  const scene::Mesh mesh = flag(3, 3);
  Motion motion = flying();
  motion.force.setZero();
  State state = initial_state(mesh);
  EXPECT_NEAR(spring_energy(mesh, state.position), 0, 1e-30);
  advance(mesh, motion, one_by_one(state.V.size()), state);
  EXPECT_GT(state.velocity.norm(), 1e-3);
}

TEST(ReferenceMotion, AFlagFliesWithThePapersSettings) {
  // Bounded for 100 steps with memory 0; with the paper's literal eq. 7 (memory 1, force on a) it falls
  // apart.
  const scene::Mesh mesh = flag(8, 8);
  const auto largest_strain = [&](Motion motion) {
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
  Motion literal = flying();
  literal.acceleration_memory = 1;
  literal.force_on_acceleration = true;
  const double memoryless = largest_strain(flying());
  EXPECT_LT(memoryless, 0.3);
  EXPECT_GT(memoryless, 0.001);
  EXPECT_GT(largest_strain(literal), 1);
}

} // namespace
} // namespace hopmesh::reference::testing
