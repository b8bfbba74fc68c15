// Energy, weights and bias: docs/method/theory.md, sections 1 and 2.
#include "sim/reference/reference.h"
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

/// A step about to be expanded.
struct NetworkCase {
  scene::Mesh mesh;
  StepParameters motion;
  Vector C, V0;
};

NetworkCase random_network(Random& random, int k) {
  const bool planar = k % 2 == 1;
  const double rest_factor[] = {1, 0, 3};
  NetworkCase c;
  c.mesh = random_mesh(random, 5 + random.below(4), planar, rest_factor[k % 3]);
  c.motion = random_motion(random);
  c.C = predict(c.mesh, c.motion, random_state(random, c.mesh));
  c.V0 = random_outputs(random, c.mesh);
  return c;
}

/// What the terms of a neuron's row are made of before they cancel: rounding errors are in proportion to
/// this.
struct Scale {
  Vector curvature, slope; ///< [nodes]
};

Scale scale_of(const NetworkCase& c) {
  const auto nodes = static_cast<Eigen::Index>(c.mesh.nodes());
  const double h = c.motion.time_step * c.motion.time_step / 2;
  Scale scale{Vector::Zero(nodes), Vector::Zero(nodes)};
  const auto place_of = [&](std::uint32_t n) { return place(c.mesh, h, c.C, widened(c.V0), n); };
  for (const auto& spring : c.mesh.springs) {
    const auto a = place_of(spring.node[0]), b = place_of(spring.node[1]);
    const double length = static_cast<double>(wide_sqrt(plain_spring({{0, 1}, 1, 0}, a, b)));
    for (const auto n : spring.node) {
      scale.curvature[n] += 2 * spring.weight * h * h * (1 + spring.rest_length / length);
      scale.slope[n] += 2 * spring.weight * h * (length + spring.rest_length);
    }
  }
  for (Eigen::Index n = 0; n < nodes; ++n) {
    const double beta = static_cast<double>(plain_beta(c.mesh, c.motion, n));
    scale.curvature[n] += 2 * beta * (1 + 1 / 0.2); // F is at least 0.2
    scale.slope[n] += 4 * beta;
  }
  return scale;
}

Eigen::Index node_of(const NetworkCase& c, Eigen::Index row) {
  return row / components(c.mesh);
}

// Error model: what finite differences lose (plain_energy.h), and what the network loses in some ten rounded
// operations an entry on differences of coordinates that may have lost two digits. Either stays below 1e-11
// of the terms that an entry is summed from, far below the 1e-6 that would already tell a right formula from
// a wrong one.
constexpr double kept = 1e-11;

TEST(ReferenceEnergy, IsTheFormulaOfPaperEquation15) {
  Random random(11);
  for (int k = 0; k < 60; ++k) {
    const NetworkCase c = random_network(random, k);
    const double plain = static_cast<double>(plain_energy(c.mesh, c.motion, c.C, widened(c.V0)));
    EXPECT_NEAR(energy(c.mesh, c.motion, c.C, c.V0), plain, 1e-13 * plain) << "case " << k;
  }
}

TEST(ReferenceEnergy, OfOneSpringByHand) {
  // 3-4-5: length 5, rest 2, weight 7: 7 * 3^2.
  scene::Mesh mesh;
  mesh.position = {{1, 1, 1}, {4, 1, 5}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, 7, 2}};
  EXPECT_EQ(spring_energy(mesh, initial_state(mesh).position), 63);
  // dt = 2, so h = 2: V = (0, 0, -1/2) takes node 1 to (4, 1, 4), length sqrt 18, plus beta dt^4 alpha
  // (1/2)^2.
  StepParameters motion{};
  motion.time_step = 2;
  motion.beta = 3;
  Vector V = Vector::Zero(6);
  V[5] = -0.5;
  const double stretch = std::sqrt(18.0) - 2;
  EXPECT_DOUBLE_EQ(energy(mesh, motion, initial_state(mesh).position, V),
                   7 * stretch * stretch + 3 * 16 * 7 / 4.0);
}

TEST(ReferenceEnergy, BetaIsDt4TimesMeanAlphaOfTheNodesSprings) {
  // Node 1 has springs of weight 2 and 6 (mean 4), node 3 none. Zero outputs cost beta_i each, unit ones
  // nothing.
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  mesh.pinned = {true, false, true, false};
  mesh.springs = {{{0, 1}, 2, 1}, {{1, 2}, 6, 1}};
  StepParameters motion{};
  motion.time_step = 0.5;
  motion.beta = 3;
  EXPECT_DOUBLE_EQ(energy(mesh, motion, initial_state(mesh).position, Vector::Zero(12)), 3 * 0.0625 * 4);
}

TEST(ReferenceNetwork, WeightsAreMinusTheHessianByFiniteDifferences) {
  Random random(21);
  for (int k = 0; k < 24; ++k) {
    const NetworkCase c = random_network(random, k);
    const Eigen::MatrixXd W = network(c.mesh, c.motion, c.C, c.V0).W;
    const Vector scale = scale_of(c).curvature;
    const double noise = difference_noise(plain_energy(c.mesh, c.motion, c.C, widened(c.V0)));
    const auto E = [&](const WideVector& V) { return plain_energy(c.mesh, c.motion, c.C, V); };
    for (Eigen::Index i = 0; i < W.rows(); ++i)
      for (Eigen::Index j = 0; j < W.cols(); ++j) {
        const bool pinned = c.mesh.pinned[node_of(c, i)] || c.mesh.pinned[node_of(c, j)];
        const double H = pinned ? 0 : curvature(E, widened(c.V0), i, j);
        ASSERT_NEAR(W(i, j), -H, kept * scale[node_of(c, i)] + noise)
            << "case " << k << " entry " << i << "," << j;
      }
  }
}

TEST(ReferenceNetwork, BiasIsHessianTimesV0MinusGradientByFiniteDifferences) {
  Random random(22);
  for (int k = 0; k < 60; ++k) {
    const NetworkCase c = random_network(random, k);
    const Network net = network(c.mesh, c.motion, c.C, c.V0);
    const Scale scale = scale_of(c);
    const auto E = [&](const WideVector& V) { return plain_energy(c.mesh, c.motion, c.C, V); };
    const Vector HV0 = -(net.W * c.V0); // W is checked above
    for (Eigen::Index i = 0; i < net.I.size(); ++i) {
      const Eigen::Index n = node_of(c, i);
      const double g = c.mesh.pinned[n] ? 0 : slope(E, widened(c.V0), i);
      ASSERT_NEAR(net.I[i], HV0[i] - g, kept * (scale.slope[n] + 3 * scale.curvature[n]))
          << "case " << k << " row " << i;
    }
  }
}

TEST(ReferenceNetwork, AgreesWithTheEnergyToSecondOrder) {
  // E(V0 + t d) - E(V0) and the same of the network differ by O(t^3): halving t leaves an eighth. Summed over
  // meshes, since in one of them the third derivative along d may happen to be small. dt = 1 keeps rounding
  // out of sight.
  Random random(23);
  const auto remainder = [&](std::uint64_t seed, double t) {
    double sum = 0;
    Random same(seed);
    for (int k = 0; k < 30; ++k) {
      NetworkCase c = random_network(same, k % 2 ? 1 : 0);
      c.motion.time_step = 1;
      const Vector V = c.V0 + t * random_outputs(same, c.mesh);
      const Network net = network(c.mesh, c.motion, c.C, c.V0);
      const Wide exact = plain_energy(c.mesh, c.motion, c.C, widened(V)) -
                         plain_energy(c.mesh, c.motion, c.C, widened(c.V0));
      sum += std::abs(static_cast<double>(exact) - (network_energy(net, V) - network_energy(net, c.V0)));
    }
    return sum;
  };
  const std::uint64_t seed = random.below(1000000);
  const double whole = remainder(seed, 1e-2), half = remainder(seed, 5e-3);
  EXPECT_GT(half, 0);
  EXPECT_NEAR(whole / half, 8, 0.4);
}

TEST(ReferenceNetwork, IsTheEnergyItselfWhereThatIsQuadratic) {
  // docs/method/theory.md, section 5, Neural Mesh (paper eq. 1): L = 0 and no beta leave nothing to expand.
  Random random(24);
  for (int k = 0; k < 40; ++k) {
    NetworkCase c = random_network(random, k);
    for (auto& spring : c.mesh.springs) spring.rest_length = 0;
    c.motion.beta = 0;
    c.motion.time_step = 1;
    const Network net = network(c.mesh, c.motion, c.C, c.V0);
    const double constant = energy(c.mesh, c.motion, c.C, c.V0) - network_energy(net, c.V0);
    const Vector V = random_outputs(random, c.mesh, 0);
    const double E = energy(c.mesh, c.motion, c.C, V);
    EXPECT_NEAR(E, constant + network_energy(net, V), 1e-13 * (std::abs(constant) + E)) << "case " << k;
  }
}

TEST(ReferenceNetwork, WeightsAreSymmetricToTheLastBit) {
  Random random(25);
  for (int k = 0; k < 200; ++k) {
    const NetworkCase c = random_network(random, k);
    const Eigen::MatrixXd W = network(c.mesh, c.motion, c.C, c.V0).W;
    ASSERT_GT(W.norm(), 0);
    for (Eigen::Index i = 0; i < W.rows(); ++i)
      for (Eigen::Index j = 0; j < i; ++j) ASSERT_EQ(W(i, j), W(j, i)) << "case " << k;
  }
}

TEST(ReferenceNetwork, HasWeightsAlongSpringsOnlyAndNoneAtPins) {
  Random random(26);
  for (int k = 0; k < 40; ++k) {
    const NetworkCase c = random_network(random, k);
    const Eigen::Index per_node = components(c.mesh);
    const Network net = network(c.mesh, c.motion, c.C, c.V0);
    Eigen::MatrixXi expected = Eigen::MatrixXi::Zero(net.W.rows(), net.W.cols());
    const auto mark = [&](std::size_t i, std::size_t j) {
      if (!c.mesh.pinned[i] && !c.mesh.pinned[j])
        expected.block(per_node * i, per_node * j, per_node, per_node).setOnes();
    };
    for (const auto& [node, weight, rest] : c.mesh.springs) mark(node[0], node[1]), mark(node[1], node[0]);
    for (std::size_t n = 0; n < c.mesh.nodes(); ++n) mark(n, n);
    Eigen::MatrixXi stored = Eigen::MatrixXi::Zero(net.W.rows(), net.W.cols());
    for (Eigen::Index i = 0; i < net.W.rows(); ++i)
      for (Matrix::InnerIterator w(net.W, i); w; ++w) stored(i, w.col()) = 1;
    ASSERT_EQ(stored, expected) << "case " << k;
    for (Eigen::Index i = 0; i < net.I.size(); ++i)
      if (c.mesh.pinned[node_of(c, i)]) {
        ASSERT_EQ(net.I[i], 0);
      }
  }
}

TEST(ReferenceNetwork, OfOneSpringByHand) {
  // dt = 1, h = 1/2, alpha = beta = 1, L = 1; node 1 hangs at (0,0,-2) below the pin and looks down.
  // u = (0,0,-5/2), L/l = 2/5: S = diag(.3, .3, .5), f = (0,0,-3/2); F = 1: B = diag(0,0,2), b = 0.
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, -2}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, 1, 1}};
  StepParameters motion{};
  motion.time_step = 1;
  motion.beta = 1;
  const State state = initial_state(mesh);
  const Network net = network(mesh, motion, predict(mesh, motion, state), expansion_point(mesh, state));
  const Eigen::Vector3d diagonal(-0.3, -0.3, -2.5), bias(0, 0, -1);
  EXPECT_TRUE(
      Eigen::MatrixXd(net.W).bottomRightCorner(3, 3).isApprox(Eigen::MatrixXd(diagonal.asDiagonal()), 1e-15));
  EXPECT_TRUE(net.I.tail(3).isApprox(bias, 1e-15));
}

TEST(ReferenceNetwork, ASpringOfNoLengthCountsAsOneWithoutRestLength) {
  // u = 0: S = 2 alpha h^2 = 3/2 at alpha 3, h 1/2; f = 0; nothing but S V0 is left of the bias.
  for (const double rest : {0.0, 2.0}) {
    scene::Mesh mesh;
    mesh.position = {{0, 0, 0}, {0, 0, 0.5}};
    mesh.pinned = {true, false};
    mesh.springs = {{{0, 1}, 3, rest}};
    StepParameters motion{};
    motion.time_step = 1;
    const State state = initial_state(mesh);
    const Network net = network(mesh, motion, state.position, expansion_point(mesh, state));
    EXPECT_EQ(Eigen::MatrixXd(net.W).bottomRightCorner(3, 3),
              Eigen::MatrixXd(-1.5 * Eigen::Matrix3d::Identity()));
    EXPECT_EQ(Eigen::Vector3d(net.I.tail(3)), Eigen::Vector3d(0, 0, -1.5));
  }
}

TEST(ReferenceNetwork, ANodeWithoutDirectionIsPulledTowardMinusZ) {
  // beta |V - m|^2 with m = (0,0,-1): W = -2 beta, I = 2 beta m. The spring at u = 0 adds 2 alpha h^2 to -W.
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, 0}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, 2, 0}};
  StepParameters motion{};
  motion.time_step = 1;
  motion.beta = 3;
  const double two_beta = 2 * 3 * 2, two_alpha_h2 = 1;
  const Network net = network(mesh, motion, Vector::Zero(6), Vector::Zero(6));
  EXPECT_EQ(Eigen::MatrixXd(net.W).bottomRightCorner(3, 3),
            Eigen::MatrixXd(-(two_beta + two_alpha_h2) * Eigen::Matrix3d::Identity()));
  EXPECT_EQ(Eigen::Vector3d(net.I.tail(3)), Eigen::Vector3d(0, 0, -two_beta));
}

TEST(ReferenceNetwork, TheModelOfANodeWithoutDirectionTouchesTheEnergyAndLiesNowhereBelow) {
  Random random(27);
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, 0}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, 2, 0}}; // quadratic already: the model's error is that of the unit-length term
  StepParameters motion{};
  motion.time_step = 1;
  motion.beta = 3;
  const Vector C = Vector::Zero(6), V0 = Vector::Zero(6);
  const Network net = network(mesh, motion, C, V0);
  const double constant = energy(mesh, motion, C, V0) - network_energy(net, V0);
  for (int k = 0; k < 200; ++k) {
    const Vector V = random_outputs(random, mesh);
    EXPECT_GE(constant + network_energy(net, V), energy(mesh, motion, C, V) - 1e-13);
  }
}

} // namespace
} // namespace hopmesh::tests
