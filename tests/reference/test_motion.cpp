// A step of the probe formulation, formula by formula: docs/method/theory.md, section 4.
#include "sim/reference/reference.h"
#include "tests/reference/flags.h"
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"
#include "tests/reference/vectors.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

Eigen::Vector3d output(const scene::Mesh& mesh, const Vector& V, std::size_t node) {
  if (mesh.planar) return {V[2 * node], 0, V[2 * node + 1]};
  return at(V, node);
}

/// Node 1 two below the pin on a spring of length 1, dt = 1 so that h = 1/2; friction 1/2; one sweep a step.
struct HangingNode {
  scene::Mesh mesh;
  StepParameters motion{};
  HangingNode() {
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

TEST(ReferenceMotion, IsReadFromTheScene) {
  scene::Scene scene;
  scene.motion = {scene::Formulation::probe, 0.25, 10, 0.75};
  scene.probe = {11, 12, 0.5, scene::EnergySprings::all, scene::ForceOn::acceleration};
  scene.relax = {1e-3, 77, 3};
  scene.force.gravity = {1, 2, 3};
  scene.force.wind = scene::Vector3{10, 20, 30};
  StepParameters motion = step_parameters(scene);
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
  scene.probe.energy_springs = scene::EnergySprings::own;
  scene.probe.force_on = scene::ForceOn::velocity;
  motion = step_parameters(scene);
  EXPECT_EQ(motion.force, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(motion.energy_of_all_springs);
  EXPECT_FALSE(motion.force_on_acceleration);
}

TEST(ReferenceMotion, PredictionKeepsTheRememberedShareOfTheAcceleration) {
  // dt = 1/2, h = 1/8, memory 1/2: 1 + 2/2 + 16/16 = 3.
  HangingNode hanging;
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
  HangingNode hanging;
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
    HangingNode hanging;
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

// Delta E_i of docs/method/theory.md, section 4, with every spring asked whether it belongs.
double brute_energy_change(const scene::Mesh& mesh, const StepParameters& motion, const Vector& x,
                           const Step& step, std::size_t i) {
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
    StepParameters motion = random_motion(random);
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
  HangingNode hanging;
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

} // namespace
} // namespace hopmesh::tests
