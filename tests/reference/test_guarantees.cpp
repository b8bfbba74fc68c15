// What the neuron's rule guarantees for any symmetric network: docs/method/theory.md, section 3.
#include "sim/reference/reference.h"
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

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

TEST(ReferenceGuarantees, EnergyFallsAtEveryFiringWhateverTheDiagonal) {
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

TEST(ReferenceGuarantees, EnergyFallsInEveryColouredPhase) {
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

TEST(ReferenceGuarantees, TwoNeuronsAllAtOnceFlipForEver) {
  Eigen::MatrixXd W(2, 2);
  W << 0, -1, -1, 0;
  const Network net = network_of(W, Vector::Zero(2));
  const Eigen::Vector2d up(1, 1), down(-1, -1);
  for (std::uint32_t sweeps = 1; sweeps < 50; ++sweeps) {
    const Relaxation rest = relax(net, {{0, 1}}, up, 0, sweeps);
    EXPECT_EQ(rest.V, sweeps % 2 ? down : up);
    EXPECT_FALSE(rest.converged);
  }
  // Neuron by neuron the same network rests, and lower.
  const Relaxation rest = relax(net, {{0}, {1}}, up, 0, 50);
  EXPECT_TRUE(rest.converged);
  EXPECT_EQ(rest.V, Eigen::Vector2d(-1, 1));
  EXPECT_LT(network_energy(net, rest.V), network_energy(net, up));
}

TEST(ReferenceGuarantees, ALoneNeuronAtABoundFlipsForEverAtEqualEnergy) {
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

TEST(ReferenceGuarantees, OutputsNeverLeaveTheBox) {
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

TEST(ReferenceGuarantees, NotByRoundingEither) {
  // Every neuron pushed as hard as it can be, u = +-1 up to rounding: outputs of the sign of their weights,
  // of any size; and 1 - V where that must be rounded, V next to 0.
  Random random(37);
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Index n = 1 + random.below(9);
    Eigen::MatrixXd W(n, n);
    for (double& w : W.reshaped()) w = random.between(0, 1);
    W = (W + W.transpose()).eval();
    W(0, 0) = 0; // or its own output, of any sign, would pull it back
    const double sign = random.chance(0.5) ? 1 : -1;
    Vector V = Vector::Constant(n, sign);
    V[0] = random.between(-1, 1) * std::ldexp(1.0, -static_cast<int>(random.below(60)));
    const Vector I = Vector::Constant(n, sign * random.between(0, 1));
    const Vector next = relax(network_of(W, I), one_by_one(n), V, 0, 2).V;
    ASSERT_LE(next.cwiseAbs().maxCoeff(), 1.0) << "network " << k;
    ASSERT_NEAR(next[0], sign, 1e-15) << "network " << k;
  }
}

TEST(ReferenceGuarantees, RestsWhereTheKktConditionsHold) {
  Random random(34);
  int inside = 0, at_bound = 0, converged = 0;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Index n = 1 + random.below(10);
    const Network net = random_network(random, n);
    Vector start(n); // inside: a lone neuron that starts at a bound may flip for ever (see there)
    for (double& v : start) v = random.between(-1, 1);
    const Relaxation rest = relax(net, one_by_one(n), start, 1e-15, 200000);
    // s = 0, or V at a bound with s pushing outward, told without the function under test. |u| * room <=
    // 1e-15 in the last sweep leaves the lesser of them below 4e-8; the slow case of
    // AMinimumAtABoundWithoutPush leaves some 1 / sweeps.
    const double tolerance = rest.converged ? 1e-7 : 10.0 / rest.sweeps;
    converged += rest.converged;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Input input = wide_input(net, rest.V, i);
      if (input.N == 0) continue;
      const double u = static_cast<double>(input.s / input.N), room = u >= 0 ? 1 - rest.V[i] : 1 + rest.V[i];
      ASSERT_LT(std::min(std::abs(u), room), tolerance)
          << "network " << k << " neuron " << i << " sweeps " << rest.sweeps;
      room < 1e-6 ? ++at_bound : ++inside;
    }
    ASSERT_LT(kkt_violation(net, rest.V), tolerance) << "network " << k;
  }
  EXPECT_GT(converged, 285);
  EXPECT_GT(inside, 100);
  EXPECT_GT(at_bound, 100);
}

TEST(ReferenceGuarantees, AnyOrderReachesTheOneMinimumOfAConvexNetwork) {
  // The minimum is chosen first, well inside or at a bound and well pushed: where a neuron rests near a bound
  // with next to no push, it gets there slowly (the test after this one), and no tolerance would be honest.
  Random random(35);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Index n = 2 + random.below(12);
    Eigen::MatrixXd W = random_network(random, n).W;
    for (Eigen::Index i = 0; i < n; ++i)
      W(i, i) = -(W.row(i).cwiseAbs().sum() + 0.5); // dominant: strictly convex
    Vector minimum(n), push(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double side = random.chance(0.4) ? (random.chance(0.5) ? 1 : -1) : 0;
      minimum[i] = side == 0 ? random.between(-0.8, 0.8) : side;
      push[i] = side * random.between(0.5, 3);
    }
    const Network net = network_of(W, push - W * minimum);
    for (const Order& order : {one_by_one(n), coloured(net.W)}) {
      const Relaxation rest = relax(net, order, random_point(random, n), 1e-14, 100000);
      ASSERT_TRUE(rest.converged) << "network " << k;
      ASSERT_LT((rest.V - minimum).cwiseAbs().maxCoeff(), 1e-9) << "network " << k;
    }
  }
}

TEST(ReferenceGuarantees, AMinimumAtABoundWithoutPushIsReachedSlowly) {
  // W = -1, I = 1: s = 1 - V = R, N = 2, so 1 - V <- (1 - V) - (1 - V)^2 / 2: after k sweeps about 2 / k is
  // left.
  const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -1), Vector::Ones(1));
  for (const std::uint32_t sweeps : {1000u, 10000u, 100000u}) {
    const double left = 1 - relax(net, one_by_one(1), Vector::Zero(1), 0, sweeps).V[0];
    EXPECT_NEAR(left * sweeps, 2, 0.05);
  }
}

TEST(ReferenceGuarantees, AnyOrderBringsANeuralMeshToTheSolutionOfItsLinearSystem) {
  // docs/method/theory.md, section 5 (paper eqs. 1 and 2): no rest lengths, no beta, every node within reach
  // of its place.
  Random random(36);
  for (int k = 0; k < 30; ++k) {
    const scene::Mesh mesh = random_mesh(random, 6 + random.below(8), k % 2 == 1, 0);
    StepParameters motion = random_motion(random);
    motion.time_step = 1;
    motion.beta = 0;
    const Vector C = 0.1 * predict(mesh, motion, random_state(random, mesh));
    const Network net = network(mesh, motion, C, random_outputs(random, mesh));
    Eigen::MatrixXd H = -net.W;
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      if (H(i, i) == 0) H(i, i) = 1; // pinned
    const Vector solution = H.ldlt().solve(net.I);
    ASSERT_LT(solution.cwiseAbs().maxCoeff(), 0.9);
    for (const Order& order : {one_by_one(H.rows()), coloured(net.W)}) {
      const Relaxation rest = relax(net, order, random_outputs(random, mesh), 1e-14, 100000);
      ASSERT_TRUE(rest.converged) << "mesh " << k;
      ASSERT_LT((rest.V - solution).cwiseAbs().maxCoeff(), 1e-9) << "mesh " << k;
    }
  }
}

} // namespace
} // namespace hopmesh::tests
