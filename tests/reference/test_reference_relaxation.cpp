// The neuron's rule and what it guarantees: docs/theory.md, section 3.
#include "sim/reference/reference.h"
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::reference::testing {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Network network_of(const Eigen::MatrixXd& W, const Vector& I) {
  return {W.sparseView(), I};
}

Vector random_point(Random& random, Eigen::Index n) {
  Vector V(n);
  // Bounds are where the rule changes sides, so start at them often.
  for (double& v : V) v = random.chance(0.3) ? (random.chance(0.5) ? 1 : -1) : random.between(-1, 1);
  return V;
}

/// s_i and N_i with digits to spare.
struct Input {
  Wide s, N;
};

Input wide_input(const Network& net, const Vector& V, Eigen::Index i) {
  Input input{net.I[i], std::abs(net.I[i])};
  for (Matrix::InnerIterator w(net.W, i); w; ++w) {
    input.s += Wide(w.value()) * V[w.col()];
    input.N += std::abs(w.value());
  }
  return input;
}

Wide wide_energy(const Network& net, const Vector& V) {
  Wide E = 0;
  for (Eigen::Index i = 0; i < V.size(); ++i) {
    E -= Wide(net.I[i]) * V[i];
    for (Matrix::InnerIterator w(net.W, i); w; ++w) E -= Wide(w.value()) * V[i] * V[w.col()] / 2;
  }
  return E;
}

// What double arithmetic may give back of the descent when neuron i fires: V is rounded by epsilon, which
// costs |s| epsilon, and s by n epsilon N, which may turn the sign of an s that small.
double slack(const Input& input, Eigen::Index n) {
  const double s = std::abs(static_cast<double>(input.s)), N = static_cast<double>(input.N);
  return 8 * epsilon * s + 16 * n * n * epsilon * epsilon * N;
}

TEST(ReferenceRelaxation, OneNeuronFollowsTheRuleByHand) {
  // W = -1/2, I = 1/2, N = 1. V = 0: u = 1/2, R = 1 -> 1/2; u = 1/4, R = 1/2 -> 5/8; u = 3/16, R = 3/8 ->
  // 89/128.
  const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -0.5), Vector::Constant(1, 0.5));
  const double expected[] = {0, 0.5, 0.625, 0.6953125};
  for (std::uint32_t sweeps = 0; sweeps < 4; ++sweeps)
    EXPECT_EQ(relax(net, one_by_one(1), Vector::Zero(1), 0, sweeps).V[0], expected[sweeps]);
}

TEST(ReferenceRelaxation, ANegativeInputMovesByTheRoomBelow) {
  // W = 0, N = |I|, u = -1: all the way down from anywhere. With W = -1, I = -1, V = 1/2: s = -3/2, u = -3/4,
  // R = 3/2.
  const Network bias_only = network_of(Eigen::MatrixXd::Zero(1, 1), Vector::Constant(1, -3));
  EXPECT_EQ(relax(bias_only, one_by_one(1), Vector::Constant(1, 0.5), 0, 1).V[0], -1);
  const Network both = network_of(Eigen::MatrixXd::Constant(1, 1, -1), Vector::Constant(1, -1));
  EXPECT_EQ(relax(both, one_by_one(1), Vector::Constant(1, 0.5), 0, 1).V[0], 0.5 - 0.75 * 1.5);
}

TEST(ReferenceRelaxation, NeuronsOfAPhaseReadTheOutputsFromBeforeIt) {
  // Neuron 0: s = V1/2 + 1/2, N = 1; neuron 1: s = V0/2, N = 1/2.
  Eigen::MatrixXd W(2, 2);
  W << 0, 0.5, 0.5, 0;
  const Network net = network_of(W, Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(relax(net, {{0, 1}}, Vector::Zero(2), 0, 1).V, Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(relax(net, {{0}, {1}}, Vector::Zero(2), 0, 1).V, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(relax(net, {{1}, {0}}, Vector::Zero(2), 0, 1).V, Eigen::Vector2d(0.5, 0));
}

TEST(ReferenceRelaxation, ANeuronWithoutInputKeepsItsOutput) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(3, 3);
  W(0, 0) = 1;
  Matrix stored_zeros = W.sparseView();
  stored_zeros.insert(1, 2) = 0;
  stored_zeros.insert(2, 1) = 0;
  const Vector V = Eigen::Vector3d(0.25, -0.375, 0.0);
  const Relaxation rest = relax({stored_zeros, Vector::Zero(3)}, {{0, 1, 2}}, V, 0, 100);
  EXPECT_EQ(rest.V, Eigen::Vector3d(1, -0.375, 0)); // neuron 0 feeds itself up; N = 0 for the others
  EXPECT_TRUE(rest.converged);
}

TEST(ReferenceRelaxation, StopsAfterTheFirstSweepThatMovesNoOutputByMoreThanTheThreshold) {
  // The neuron of OneNeuronFollowsTheRuleByHand moves by 1/2, 1/8, 9/128.
  const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -0.5), Vector::Constant(1, 0.5));
  const auto sweeps = [&](double threshold) {
    const Relaxation rest = relax(net, one_by_one(1), Vector::Zero(1), threshold, 100);
    EXPECT_TRUE(rest.converged);
    return rest.sweeps;
  };
  EXPECT_EQ(sweeps(0.5), 1u);
  EXPECT_EQ(sweeps(0.125), 2u);
  EXPECT_EQ(sweeps(std::nextafter(0.125, 0)), 3u);
  EXPECT_EQ(sweeps(0.0703125), 3u);
  EXPECT_EQ(sweeps(std::nextafter(0.0703125, 0)), 4u);
}

TEST(ReferenceRelaxation, TheLargestMoveOfAllPhasesCounts) {
  // Neuron 0 moves by 1 in its phase, neuron 1 by nothing in the last one.
  const Network net = network_of(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1, 0));
  EXPECT_EQ(relax(net, {{0}, {1}}, Vector::Zero(2), 0.5, 100).sweeps, 2u);
}

TEST(ReferenceRelaxation, GivesUpAtMaxSweepsAndSaysSo) {
  const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -0.5), Vector::Constant(1, 0.5));
  const Relaxation rest = relax(net, one_by_one(1), Vector::Zero(1), 0.1, 2);
  EXPECT_EQ(rest.sweeps, 2u);
  EXPECT_FALSE(rest.converged);
  EXPECT_TRUE(relax(net, one_by_one(1), Vector::Zero(1), 0.125, 2).converged);
}

TEST(ReferenceRelaxation, EnergyFallsAtEveryFiringWhateverTheDiagonal) {
  Random random(31);
  std::size_t moves = 0;
  for (int k = 0; k < 1200; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network net = random_network(random, n);
    Vector V = random_point(random, n);
    for (int firing = 0; firing < 5 * n; ++firing) {
      const Eigen::Index i = random.below(static_cast<std::uint32_t>(n));
      const Vector next = relax(net, {{static_cast<std::uint32_t>(i)}}, V, 0, 1).V;
      const Input input = wide_input(net, V, i);
      const Wide moved = Wide(next[i]) - V[i];
      const Wide change = wide_energy(net, next) - wide_energy(net, V);
      // The formula of section 3 is the difference of the energies, and it is not positive.
      const Wide formula = -input.s * moved - Wide(net.W.coeff(i, i)) * moved * moved / 2;
      ASSERT_NEAR(static_cast<double>(change - formula), 0, 1e-28) << "network " << k;
      ASSERT_LE(static_cast<double>(change), slack(input, n)) << "network " << k << " neuron " << i;
      moves += change < -1e-12;
      V = next;
    }
  }
  EXPECT_GT(moves, 10000u); // the networks did have somewhere to go
}

TEST(ReferenceRelaxation, EnergyFallsInEveryColouredPhase) {
  Random random(32);
  std::size_t together = 0;
  for (int k = 0; k < 1200; ++k) {
    const Eigen::Index n = 2 + random.below(20);
    const Network net = random_network(random, n);
    Vector V = random_point(random, n);
    const Order order = coloured(net.W);
    for (std::size_t phase = 0; phase < 3 * order.size(); ++phase) {
      const auto& neurons = order[phase % order.size()];
      const Vector next = relax(net, {neurons}, V, 0, 1).V;
      double allowed = 0;
      for (const auto i : neurons) allowed += slack(wide_input(net, V, i), n);
      ASSERT_LE(static_cast<double>(wide_energy(net, next) - wide_energy(net, V)), allowed)
          << "network " << k;
      together += neurons.size() > 1 && next != V;
      V = next;
    }
  }
  EXPECT_GT(together, 1000u); // phases of several neurons did fire
}

TEST(ReferenceRelaxation, TwoNeuronsAllAtOnceFlipForEver) {
  Eigen::MatrixXd W(2, 2);
  W << 0, -1, -1, 0;
  const Network net = network_of(W, Vector::Zero(2));
  const Eigen::Vector2d up(1, 1), down(-1, -1);
  for (std::uint32_t sweeps = 1; sweeps < 50; ++sweeps) {
    const Relaxation rest = relax(net, {{0, 1}}, up, 0, sweeps);
    EXPECT_EQ(rest.V, sweeps % 2 ? down : up);
    EXPECT_FALSE(rest.converged);
  }
  // One at a time the same network rests, and lower.
  const Relaxation rest = relax(net, {{0}, {1}}, up, 0, 50);
  EXPECT_TRUE(rest.converged);
  EXPECT_EQ(rest.V, Eigen::Vector2d(-1, 1));
  EXPECT_LT(network_energy(net, rest.V), network_energy(net, up));
}

TEST(ReferenceRelaxation, ALoneNeuronAtABoundFlipsForEverAtEqualEnergy) {
  // The one case where the energy does not fall though the neuron moves: no bias, no neighbour, W_ii < 0, |V|
  // = 1. Then u = -V and R = 2. Any other start, or the smallest bias, comes to rest.
  const Eigen::MatrixXd W = Eigen::MatrixXd::Constant(1, 1, -2);
  const Network net = network_of(W, Vector::Zero(1));
  const Vector one = Vector::Ones(1);
  EXPECT_EQ(relax(net, one_by_one(1), one, 0, 7).V[0], -1);
  EXPECT_EQ(relax(net, one_by_one(1), one, 0, 8).V[0], 1);
  EXPECT_FALSE(relax(net, one_by_one(1), one, 0, 1000).converged);
  EXPECT_TRUE(relax(net, one_by_one(1), 0.99 * one, 1e-6, 1000000).converged);
  EXPECT_TRUE(relax(network_of(W, 0.1 * one), one_by_one(1), one, 1e-12, 1000).converged);
}

TEST(ReferenceRelaxation, OutputsNeverLeaveTheBox) {
  Random random(33);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network net = random_network(random, n);
    Order all_at_once(1);
    for (std::uint32_t i = 0; i < n; ++i) all_at_once[0].push_back(i);
    Vector V = random_point(random, n);
    for (int sweep = 0; sweep < 30; ++sweep) {
      V = relax(net, sweep % 2 ? all_at_once : one_by_one(n), V, 0, 1).V;
      ASSERT_LE(V.cwiseAbs().maxCoeff(), 1.0) << "network " << k;
    }
  }
}

TEST(ReferenceRelaxation, RestsWhereTheKktConditionsHold) {
  Random random(34);
  int inside = 0, at_bound = 0;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Index n = 1 + random.below(10);
    const Network net = random_network(random, n);
    Vector start(n); // inside: a lone neuron that starts at a bound may flip for ever (see there)
    for (double& v : start) v = random.between(-1, 1);
    const Relaxation rest = relax(net, one_by_one(n), start, 1e-15, 200000);
    // s = 0, or V at a bound with s pushing outward, told without the function under test.
    for (Eigen::Index i = 0; i < n; ++i) {
      const Input input = wide_input(net, rest.V, i);
      if (input.N == 0) continue;
      const double u = static_cast<double>(input.s / input.N), room = u >= 0 ? 1 - rest.V[i] : 1 + rest.V[i];
      ASSERT_LT(std::min(std::abs(u), room), 1e-6)
          << "network " << k << " neuron " << i << " sweeps " << rest.sweeps;
      room < 1e-6 ? ++at_bound : ++inside;
    }
    ASSERT_LT(kkt_violation(net, rest.V), 1e-6) << "network " << k;
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(at_bound, 100);
}

TEST(ReferenceRelaxation, KktViolationByHand) {
  // u = V1 / 2 + 1 / 2 and u = V0.
  Eigen::MatrixXd W(2, 2);
  W << 0, 0.5, 0.5, 0;
  const Network net = network_of(W, Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(kkt_violation(net, Eigen::Vector2d(1, 1)), 0);       // both pushed outward
  EXPECT_EQ(kkt_violation(net, Eigen::Vector2d(0, 0)), 0.5);     // neuron 0 inside, u = 1/2
  EXPECT_EQ(kkt_violation(net, Eigen::Vector2d(1, 0.75)), 0.25); // neuron 1 short of its bound
  EXPECT_EQ(kkt_violation(net, Eigen::Vector2d(-1, 1)), 1);      // at the wrong bounds, pushed inward
  EXPECT_EQ(kkt_violation(net, Eigen::Vector2d(0, -1)), 0);      // s = 0 inside, and s = 0 at a bound
}

TEST(ReferenceRelaxation, AnyOrderReachesTheOneMinimumOfAConvexNetwork) {
  Random random(35);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Index n = 2 + random.below(12);
    Network net = random_network(random, n);
    // More than the sum of a row's others on the diagonal: strictly convex, so the box holds one minimum
    // only.
    Eigen::MatrixXd W = net.W;
    for (Eigen::Index i = 0; i < n; ++i) W(i, i) = -(W.row(i).cwiseAbs().sum() + 0.5);
    net.W = W.sparseView();
    for (double& bias : net.I) bias = random.between(-6, 6); // enough to push some into the bounds
    const auto rest = [&](const Order& order) {
      const Relaxation r = relax(net, order, random_point(random, n), 1e-15, 100000);
      EXPECT_TRUE(r.converged);
      return r.V;
    };
    const Vector one = rest(one_by_one(n)), other = rest(coloured(net.W));
    ASSERT_LT((one - other).cwiseAbs().maxCoeff(), 1e-9) << "network " << k;
  }
}

TEST(ReferenceRelaxation, AnyOrderReachesTheSameRestOnAMesh) {
  // Springs without rest length and no unit-length term: convex, and at dt = 1 the outputs rest inside the
  // box too.
  Random random(36);
  for (int k = 0; k < 30; ++k) {
    const scene::Mesh mesh = random_mesh(random, 6 + random.below(8), k % 2 == 1, 0);
    Motion motion = random_motion(random);
    motion.time_step = 1;
    motion.beta = 0;
    const Vector C = predict(mesh, motion, random_state(random, mesh));
    const Network net = network(mesh, motion, C, random_outputs(random, mesh));
    const Vector start = random_outputs(random, mesh);
    const Relaxation one = relax(net, one_by_one(start.size()), start, 1e-15, 100000);
    const Relaxation other = relax(net, coloured(net.W), start, 1e-15, 100000);
    ASSERT_TRUE(one.converged && other.converged);
    ASSERT_LT((one.V - other.V).cwiseAbs().maxCoeff(), 1e-9) << "mesh " << k;
  }
}

} // namespace
} // namespace hopmesh::reference::testing
