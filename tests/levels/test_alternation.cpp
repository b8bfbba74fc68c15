// Networks whose swing is known: alternation() tells a cycle of two states from a walk and from a swing that
// dies.
#include "sim/levels/reference_check.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace levels;

using reference::Vector;

/// Two neurons that fire together.
const reference::Order together{{0, 1}}, in_turn{{0}, {1}};

reference::Network two_neurons(double own, double other, double bias) {
  reference::Network network{reference::Matrix(2, 2), Vector::Constant(2, bias)};
  for (int i = 0; i < 2; ++i) {
    network.W.insert(i, i) = own;
    network.W.insert(i, 1 - i) = other;
  }
  return network;
}

// docs/method/theory.md, section 3: W = [[0, -1], [-1, 0]] flips (1, 1) to (-1, -1) and back for ever.
TEST(Alternation, IsOneForTheCycleOfTwo) {
  EXPECT_EQ(alternation(two_neurons(0, -1, 0), together, Vector::Ones(2)), 1);
}

TEST(Alternation, IsNoneOneByOne) {
  EXPECT_EQ(alternation(two_neurons(0, -1, 0), in_turn, Vector::Ones(2)), 0);
}

TEST(Alternation, IsNoneAtRest) {
  EXPECT_EQ(alternation(two_neurons(-1, 0, 0), together, Vector::Zero(2)), 0);
}

// From 0 towards 1, a two-thousandth of what is left a sweep.
TEST(Alternation, IsNoneForASlowWalk) {
  EXPECT_EQ(alternation(two_neurons(-1, 0.999, 1e-3), together, Vector::Zero(2)), 0);
}

// s = -1.2 v, N = 1.2, R = 1 + |v|: from 0.5 to -0.25 to 0.0625 to -0.0039.
TEST(Alternation, IsNoneForASwingThatDies) {
  Vector V(2);
  V << 0.5, 0.5;
  const reference::Network network = two_neurons(-0.2, -1, 0);
  EXPECT_LT(alternation(network, together, V), 0.1);
}

} // namespace
} // namespace hopmesh::tests
