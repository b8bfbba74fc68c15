// The rest below given outputs, found without a neuron: by hand, against relaxation to its end, and where no
// rest is the only one.
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

TEST(ReferenceRest, OneNeuronByHand) {
  // E = V^2 - I V: the rest is I / 2, or the bound.
  for (const double I : {-3.0, -1.0, 0.0, 0.5, 2.0, 7.0}) {
    const Network net = network_of(Eigen::MatrixXd::Constant(1, 1, -2), Vector::Constant(1, I));
    const double rest = std::clamp(I / 2, -1.0, 1.0);
    EXPECT_NEAR(rest_below(net, Vector::Constant(1, 0.25))[0], rest, 1e-14);
    const double V = 0.25, wanted = (V * V - I * V) - (rest * rest - I * rest);
    EXPECT_NEAR(fall(net, Vector::Constant(1, V), Vector::Constant(1, rest)), wanted, 1e-15);
  }
}

TEST(ReferenceRest, OnlyNeuronsThatMayMoveCount) {
  const Network net = network_of(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(3, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(0, 0)), Eigen::Vector2d(3, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(1, 1)), Eigen::Vector2d(0, -5));
  EXPECT_EQ(movable_input(net, Eigen::Vector2d(1, -1)), Eigen::Vector2d(0, 0));
}

Eigen::MatrixXd random_symmetric(Random& random, Eigen::Index n) {
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index k = 0; k < A.size(); ++k) A(k) = random.between(-1, 1);
  return A + A.transpose();
}

Vector random_vector(Random& random, Eigen::Index n, double size) {
  Vector v(n);
  for (Eigen::Index k = 0; k < n; ++k) v[k] = random.between(-size, size);
  return v;
}

// Negative definite networks have one rest; some of them at bounds.
TEST(ReferenceRest, IsWhereRelaxationEnds) {
  Random random(71);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Eigen::MatrixXd A = random_symmetric(random, n);
    const Eigen::MatrixXd W = -(A * A + 0.3 * Eigen::MatrixXd::Identity(n, n));
    const Network net = network_of(W, random_vector(random, n, k % 2 ? 1 : 20));
    const Vector V = random_vector(random, n, 1);
    const Vector rest = rest_below(net, V);
    EXPECT_LT(kkt_violation(net, rest), 1e-9) << "case " << k;
    const Relaxation wanted = relax(net, one_by_one(static_cast<std::uint32_t>(n)), V, 1e-15, 200000);
    EXPECT_LT((rest - wanted.V).cwiseAbs().maxCoeff(), 1e-6) << "case " << k;
    EXPECT_GE(fall(net, wanted.V, rest), -1e-12 * W.cwiseAbs().maxCoeff()) << "case " << k;
  }
}

TEST(ReferenceRest, LiesBelowWhateverTheNetwork) {
  Random random(72);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network net = network_of(random_symmetric(random, n), random_vector(random, n, 2));
    const Vector V = random_vector(random, n, 1), rest = rest_below(net, V);
    EXPECT_GE(fall(net, V, rest), 0) << "case " << k;
    EXPECT_LE(rest.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT(kkt_violation(net, rest), 1e-9) << "case " << k;
    EXPECT_NEAR(fall(net, V, rest), network_energy(net, V) - network_energy(net, rest), 1e-11);
    EXPECT_NEAR(fall(net, rest, rest_below(net, rest)), 0, 1e-12) << "case " << k;
  }
}

} // namespace
} // namespace hopmesh::tests
