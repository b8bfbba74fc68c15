// Output stages beyond the paper's, and the rule to stop by, in double: by hand, and what they guarantee
// (docs/method/theory.md, section 3).
#include "sim/reference/sweeper.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace hopmesh::tests {
namespace {

using namespace reference;

NeuronRule projected(double relaxation) {
  return {Neuron::projected, relaxation};
}

NeuronRule momentum(std::vector<double> table) {
  return {Neuron::momentum, 1, std::move(table)};
}

Network lone(double weight, double bias) {
  return network_of(Eigen::MatrixXd::Constant(1, 1, weight), Vector::Constant(1, bias));
}

double after(const Network& net, double V, std::uint32_t sweeps, const NeuronRule& rule) {
  return relax(net, one_by_one(1), Vector::Constant(1, V), -1, sweeps, rule).V[0];
}

Order all_at_once(Eigen::Index n) {
  Order order(1);
  for (Eigen::Index i = 0; i < n; ++i) order[0].push_back(static_cast<std::uint32_t>(i));
  return order;
}

// s = 1 - 2 V and |w| = 2: Gauss and Seidel's step ends at 1/2; half as far again overshoots by a half.
TEST(ReferenceRules, ProjectedStepsByOmegaTimesTheInputOverTheOwnWeight) {
  EXPECT_EQ(after(lone(-2, 1), 0, 1, projected(1)), 0.5);
  EXPECT_EQ(after(lone(-2, 1), 0, 1, projected(1.5)), 0.75);
  EXPECT_EQ(after(lone(-2, 1), 0, 2, projected(1.5)), 0.375);
  EXPECT_EQ(after(lone(2, 1), 0.25, 1, projected(0.5)), 0.625); // away from a maximum too, by 3/4 / 2
}

TEST(ReferenceRules, ProjectedIsHeldInTheBoxAndGoesToABoundWithoutAnOwnWeight) {
  EXPECT_EQ(after(lone(-0.25, 3), -1, 1, projected(1)), 1); // s / |w| is 13, of which 2 are taken
  EXPECT_EQ(after(lone(0, -0.1), 0.5, 1, projected(1)), -1);
  EXPECT_EQ(after(lone(0, 0.1), -0.5, 1, projected(0.1)), 1);
  EXPECT_EQ(after(lone(0, 0), 0.5, 1, projected(1)), 0.5);
}

/// Two like neurons that pull each other: s = bias - V / 2, sum |w| = 3/2.
Network pair(double bias) {
  Eigen::MatrixXd W(2, 2);
  W << -1, 0.5, 0.5, -1;
  return network_of(W, Vector::Constant(2, bias));
}

double of_pair(double bias, std::uint32_t sweeps, const NeuronRule& rule) {
  const Vector V = relax(pair(bias), all_at_once(2), Vector::Zero(2), -1, sweeps, rule).V;
  EXPECT_NEAR(V[0], V[1], 1e-15); // sums in another order
  return V[0];
}

// V' = Y + (1/2 - Y) / 3 with a bias of 1/4, and m = 1: Y 0, V 1/6; Y 1/3, V 7/18; Y 11/18, V 31/54, where s
// is below zero and the move above: a restart, so Y is V, and the next V is 31/54 - 4/162.
TEST(ReferenceRules, MomentumGoesOnFromAheadAndRestartsWhereItWentTooFar) {
  const NeuronRule whole = momentum({1});
  EXPECT_NEAR(of_pair(0.25, 1, whole), 1.0 / 6, 1e-15);
  EXPECT_NEAR(of_pair(0.25, 2, whole), 7.0 / 18, 1e-15);
  EXPECT_NEAR(of_pair(0.25, 3, whole), 31.0 / 54, 1e-15);
  EXPECT_NEAR(of_pair(0.25, 4, whole), 31.0 / 54 - 4.0 / 162, 1e-15);
  // Then m = 1 again: Y = V + (V - V before) = 89/162 - 4/162, and a third of what is left to 1/2 goes on.
  EXPECT_NEAR(of_pair(0.25, 5, whole), 85.0 / 162 - 4.0 / 486, 1e-15);
}

// A table of several entries begins anew behind a restart, with its second: the first is what a start takes.
TEST(ReferenceRules, MomentumTakesItsTableEntryByEntryAndTheLastOneHoldsOn) {
  // As above with m = 1, 1, 1/2, 1/2, ...; behind the restart m = 1 once more, then 1/2.
  const NeuronRule table = momentum({1, 1, 0.5});
  EXPECT_NEAR(of_pair(0.25, 4, table), 31.0 / 54 - 4.0 / 162, 1e-15);
  EXPECT_NEAR(of_pair(0.25, 5, table), 85.0 / 162 - 4.0 / 486, 1e-15);
  // m = 0, 0, 1/2: V 1/6, 5/18, 19/54; then Y = V + (19/54 - 15/54) / 2 = 21/54, on by a third of 6/54.
  EXPECT_NEAR(of_pair(0.25, 4, momentum({0, 0, 0.5})), 23.0 / 54, 1e-15);
  // V moved by 4/54 again, so Y = 25/54.
  EXPECT_NEAR(of_pair(0.25, 5, momentum({0, 0, 0.5})), 25.0 / 54 + 2.0 / 162, 1e-15);
  EXPECT_NEAR(of_pair(0.25, 5, momentum({})), 0.5 - 0.5 * std::pow(2.0 / 3, 5), 1e-15);
}

TEST(ReferenceRules, MomentumStaysInTheBoxWhereverItLooks) {
  // Bias 3: u is held at 1, V and Y at 1.
  EXPECT_EQ(of_pair(3, 1, momentum({1})), 1);
  EXPECT_EQ(of_pair(3, 2, momentum({1})), 1);
  // Nothing reaches the neuron but its bias: the sign of that.
  EXPECT_EQ(after(lone(0, -0.1), 0.5, 1, momentum({0})), -0.5);
  EXPECT_EQ(after(lone(0, 0), 0.5, 3, momentum({1})), 0.5);
}

TEST(ReferenceRules, MomentumFiresAllNeuronsAtOnceOrNone) {
  EXPECT_THROW(relax(pair(0), one_by_one(2), Vector::Zero(2), 0, 1, momentum({0})), std::logic_error);
}

TEST(ReferenceRules, TheSequenceIsFistas) {
  const std::vector<double> m = fista(4);
  const double t1 = (1 + std::sqrt(5.0)) / 2, t2 = (1 + std::sqrt(1 + 4 * t1 * t1)) / 2;
  ASSERT_EQ(m.size(), 4u);
  EXPECT_EQ(m[0], 0);
  EXPECT_NEAR(m[1], (t1 - 1) / t2, 1e-15);
  EXPECT_NEAR(m[1], 0.2817, 1e-4);
  EXPECT_GT(m[3], m[2]);
  EXPECT_NEAR(fista(4096).back(), 1 - 3.0 / 4096, 1e-5); // t_k is about k / 2
}

// ---- when to stop

std::uint32_t sweeps_by_share(const Network& net, double V, double share, const NeuronRule& rule = {}) {
  const Relaxation rest = relax(net, one_by_one(1), Vector::Constant(1, V), Stop{2, 100, share}, rule);
  EXPECT_TRUE(rest.converged);
  return rest.sweeps;
}

// The neuron of the paper's rule by hand: V 0, 1/2, 5/8, 89/128; s 1/2, 1/4, 3/16, 39/256.
TEST(ReferenceRules, StopsByAShareOfTheFirstSweepsInput) {
  const Network net = lone(-0.5, 0.5);
  EXPECT_EQ(sweeps_by_share(net, 0, 0.5), 2u);
  EXPECT_EQ(sweeps_by_share(net, 0, 0.375), 3u);
  EXPECT_EQ(sweeps_by_share(net, 0, std::nextafter(0.375, 0)), 4u);
  EXPECT_EQ(sweeps_by_share(lone(-1, 0.5), 0.5, 0), 1u); // s = 0 at once
}

// s = 1 whatever V: it counts while V is below 1, and at that bound no longer.
TEST(ReferenceRules, AnInputThatHoldsAnOutputAtItsBoundDoesNotCount) {
  EXPECT_EQ(sweeps_by_share(lone(0, 1), 1, 0), 1u);
  EXPECT_EQ(sweeps_by_share(lone(0, -1), -1, 0), 1u);
  EXPECT_EQ(sweeps_by_share(lone(0, 1), 0, 0), 2u);
  EXPECT_EQ(sweeps_by_share(lone(0, 1), -1, 0, {Neuron::binary}), 2u);
  EXPECT_EQ(sweeps_by_share(lone(0, 1), -1, 0, projected(1)), 2u);
  EXPECT_EQ(sweeps_by_share(lone(0, 1), -1, 0, momentum({0})), 3u); // -1, 0, 1
}

// Neuron 0 in the first phase has the larger input, neuron 1 fires last.
TEST(ReferenceRules, TheLargestInputOfAllPhasesCounts) {
  const Network net = network_of(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1, 0.25));
  const Order order{{0}, {1}};
  Sweeper sweeper(net, order, {}, Vector::Zero(2));
  const Swept swept = sweeper.sweep();
  EXPECT_EQ(swept.largest_input, 1);
  EXPECT_EQ(swept.largest_change, 1);
  EXPECT_EQ(sweeper.sweep().largest_input, 0);
}

// ---- what is guaranteed

/// What rounding may give back: outputs, inputs and energies are sums of n terms of that size.
double slack(const Network& net) {
  const double size = Eigen::MatrixXd(net.W).cwiseAbs().sum() + net.I.cwiseAbs().sum();
  return 1e-14 * size;
}

TEST(ReferenceRules, ProjectedNeverClimbsNeuronByNeuronOrColourByColour) {
  Random random(61);
  std::size_t falls = 0;
  for (int k = 0; k < 600; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network net = random_network(random, n);
    const Order order = random.chance(0.5) ? one_by_one(n) : coloured(net.W);
    Sweeper sweeper(net, order, projected(random.between(0.05, 1.99)), random_point(random, n));
    for (int sweep = 0; sweep < 10; ++sweep) {
      const Vector before = sweeper.V();
      sweeper.sweep();
      const double fallen = fall(net, before, sweeper.V());
      ASSERT_GE(fallen, -slack(net)) << "network " << k << " sweep " << sweep;
      ASSERT_LE(sweeper.V().cwiseAbs().maxCoeff(), 1);
      falls += fallen > 1e-12;
    }
  }
  EXPECT_GT(falls, 1500u);
}

// The paper's rule flips two neurons for ever when they fire at once; without momentum this one rests.
TEST(ReferenceRules, AllAtOnceNeverClimbsWithoutMomentum) {
  Random random(62);
  std::size_t falls = 0;
  for (int k = 0; k < 600; ++k) {
    const Eigen::Index n = 1 + random.below(20);
    const Network net = random_network(random, n);
    const Order order = all_at_once(n);
    Sweeper sweeper(net, order, momentum({0}), random_point(random, n));
    for (int sweep = 0; sweep < 20; ++sweep) {
      const Vector before = sweeper.V();
      sweeper.sweep();
      const double fallen = fall(net, before, sweeper.V());
      ASSERT_GE(fallen, -slack(net)) << "network " << k << " sweep " << sweep;
      falls += fallen > 1e-12;
    }
  }
  EXPECT_GT(falls, 3000u);
  Eigen::MatrixXd W(2, 2);
  W << 0, -1, -1, 0;
  const Network flips = network_of(W, Vector::Zero(2));
  EXPECT_TRUE(relax(flips, all_at_once(2), Eigen::Vector2d(1, 0.5), 0, 100, momentum({0})).converged);
}

/// A convex network whose minimum is known: well inside, or at a bound and well pushed.
Network with_minimum(Random& random, Eigen::Index n, Vector& minimum) {
  Eigen::MatrixXd W = random_network(random, n).W;
  for (Eigen::Index i = 0; i < n; ++i) W(i, i) = -(W.row(i).cwiseAbs().sum() - std::abs(W(i, i)) + 0.1);
  Vector push(n);
  minimum.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double side = random.chance(0.4) ? (random.chance(0.5) ? 1 : -1) : 0;
    minimum[i] = side == 0 ? random.between(-0.8, 0.8) : side;
    push[i] = side * random.between(0.5, 3);
  }
  return network_of(W, push - W * minimum);
}

TEST(ReferenceRules, EveryStageComesToTheOneMinimumWithBoundsActiveAndStopsThere) {
  Random random(63);
  int held = 0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Index n = 2 + random.below(12);
    Vector minimum;
    const Network net = with_minimum(random, n, minimum);
    const double omega = random.between(0.5, 1.9);
    const Vector start = random_point(random, n);
    const Stop stop{0, 20000, 1e-12};
    for (const auto& [order, rule] : {std::pair<Order, NeuronRule>{one_by_one(n), projected(omega)},
                                      {coloured(net.W), projected(omega)},
                                      {all_at_once(n), momentum(fista(4096))},
                                      {all_at_once(n), momentum({0.9})}}) {
      const Relaxation rest = relax(net, order, start, stop, rule);
      ASSERT_TRUE(rest.converged) << "network " << k;
      ASSERT_LT((rest.V - minimum).cwiseAbs().maxCoeff(), 1e-9) << "network " << k;
      ASSERT_LT(kkt_violation(net, rest.V), 1e-9);
      for (Eigen::Index i = 0; i < n; ++i) held += std::abs(minimum[i]) == 1;
    }
  }
  EXPECT_GT(held, 500);
}

} // namespace
} // namespace hopmesh::tests
