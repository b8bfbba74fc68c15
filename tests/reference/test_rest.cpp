// The rest of a network against the readable reference's KKT measure, its rule run to the end, and networks
// solved by hand.
#include "sim/reference/rest.h"
#include "tests/reference/random_inputs.h"
#include "tests/reference/vectors.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

Rest rest_of(const Network& network, const Vector& V) {
  return rest_from(BlockNetwork(network, 1), V);
}

/// -W = A A' + shift: definite.
Network definite_network(Random& random, Eigen::Index n) {
  Eigen::MatrixXd A(n, n);
  for (double& a : A.reshaped()) a = random.between(-1, 1);
  Vector I(n);
  for (double& i : I) i = random.between(-2, 2);
  const double shift = random.between(0.05, 1);
  return network_of(-(A * A.transpose() + shift * Eigen::MatrixXd::Identity(n, n)), I);
}

long double exact_energy(const Network& network, const Vector& V) {
  long double sum = 0;
  for (Eigen::Index i = 0; i < V.size(); ++i) {
    sum -= static_cast<long double>(network.I[i]) * V[i];
    for (Matrix::InnerIterator w(network.W, i); w; ++w)
      sum -= 0.5L * w.value() * V[i] * static_cast<long double>(V[w.col()]);
  }
  return sum;
}

TEST(Rest, IsTheReadableReferencesOnDefiniteNetworks) {
  Random random(821);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Index n = 1 + random.below(8);
    const Network network = definite_network(random, n);
    const Rest rest = rest_of(network, random_point(random, n));
    EXPECT_TRUE(rest.found);
    EXPECT_LT(kkt_violation(network, rest.V), 1e-15);
    const Relaxation slow = relax(network, one_by_one(n), Vector::Zero(n), 0, 200'000);
    // An output whose bound only just holds it comes there like 1/k (docs/method/theory.md, section 3).
    if (kkt_violation(network, slow.V) < 1e-15) {
      EXPECT_LT(difference(slow.V, rest.V), 1e-10) << n;
    }
    EXPECT_GE(energy_above(BlockNetwork(network, 1), rest.V, slow.V), -1e-17);
  }
}

TEST(Rest, IsTheSameFromAnywhereOnDefiniteNetworks) {
  Random random(822);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Index n = 1 + random.below(20);
    const Network network = definite_network(random, n);
    const Rest one = rest_of(network, random_point(random, n)),
               other = rest_of(network, random_point(random, n));
    EXPECT_LT(difference(one.V, other.V), 1e-11);
  }
}

TEST(Rest, LiesBelowItsStartAndMeetsTheKktConditionsOnAnyNetwork) {
  Random random(823);
  for (int k = 0; k < 500; ++k) {
    const Eigen::Index n = 1 + random.below(20);
    const Network network = random_network(random, n);
    const Vector start = random_point(random, n);
    const Rest rest = rest_of(network, start);
    EXPECT_TRUE(rest.found);
    EXPECT_LE(rest.V.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT(kkt_violation(network, rest.V), 4e-15);
    EXPECT_LE(exact_energy(network, rest.V), exact_energy(network, start) + 1e-14L);
  }
}

// W = -2, I = 1: s = 0 at 1/2. With I = 3 the box ends first.
TEST(Rest, OfOneNeuron) {
  const auto rest = [](double bias) {
    return rest_of(network_of(Eigen::MatrixXd::Constant(1, 1, -2), Vector::Constant(1, bias)),
                   Vector::Zero(1))
        .V[0];
  };
  EXPECT_DOUBLE_EQ(rest(1), 0.5);
  EXPECT_EQ(rest(3), 1);
  EXPECT_EQ(rest(-3), -1);
}

// W = 0: only the bias says where to go, and nothing where there is none.
TEST(Rest, OfNeuronsThatNoWeightReaches) {
  Vector I = Vector::Zero(3), V = Vector::Zero(3);
  I << 2, -1e-3, 0;
  V << -1, 0.5, 0.25;
  const Rest rest = rest_of({Matrix(3, 3), I}, V);
  EXPECT_EQ(rest.V[0], 1);
  EXPECT_EQ(rest.V[1], -1);
  EXPECT_EQ(rest.V[2], 0.25);
  EXPECT_TRUE(rest.found);
}

// Energy -V^2 / 2: both bounds are rests, and the start's side decides. In the middle nothing pushes.
TEST(Rest, OfAHillIsTheBoundOnItsSide) {
  const Network hill = network_of(Eigen::MatrixXd::Ones(1, 1), Vector::Zero(1));
  EXPECT_EQ(rest_of(hill, Vector::Constant(1, 0.1)).V[0], 1);
  EXPECT_EQ(rest_of(hill, Vector::Constant(1, -0.1)).V[0], -1);
  EXPECT_EQ(rest_of(hill, Vector::Zero(1)).V[0], 0);
}

// Along (1, -1) the energy is flat: what starts there stays, however the sums are rounded.
TEST(Rest, LeavesAloneWhatNothingDecides) {
  Eigen::MatrixXd W = -Eigen::MatrixXd::Ones(2, 2);
  Vector V = Vector::Zero(2);
  V << 0.7, -0.3;
  const Rest rest = rest_of(network_of(W, Vector::Constant(2, 0.4)), V);
  EXPECT_LT(difference(rest.V, V), 1e-15);
}

TEST(Rest, EnergyAboveIsTheDifferenceOfEnergies) {
  Random random(824);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network network = random_network(random, n);
    const Vector a = random_point(random, n), b = random_point(random, n);
    EXPECT_NEAR(energy_above(BlockNetwork(network, 1), a, b),
                static_cast<double>(exact_energy(network, b) - exact_energy(network, a)), 1e-13);
  }
}

TEST(Rest, OfNothingIsNothing) {
  EXPECT_TRUE(rest_of({Matrix(0, 0), Vector(0)}, Vector(0)).found);
}

TEST(ReferenceRest, OnlyNeuronsThatMayMoveCountAsLeft) {
  const Network net = network_of(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(3, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(0, 0)), Eigen::Vector2d(3, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(1, 1)), Eigen::Vector2d(0, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(1, -1)), Eigen::Vector2d(0, 0));
}

TEST(ReferenceRest, FallIsTheDifferenceOfTwoEnergies) {
  // E = V^2 - I V: the rest is I / 2, or the bound.
  for (const double I : {-3.0, -1.0, 0.0, 0.5, 2.0, 7.0}) {
    const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -2), Vector::Constant(1, I));
    const double rest = std::clamp(I / 2, -1.0, 1.0), V = 0.25;
    EXPECT_NEAR(rest_of(net, Vector::Constant(1, V)).V[0], rest, 1e-14);
    const double wanted = (V * V - I * V) - (rest * rest - I * rest);
    EXPECT_NEAR(fall(net, Vector::Constant(1, V), Vector::Constant(1, rest)), wanted, 1e-15);
  }
}

} // namespace
} // namespace hopmesh::tests
