// The neuron's rule and the relaxation, by hand: docs/method/theory.md, section 3.
#include "sim/reference/reference.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

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

TEST(ReferenceRelaxation, BinaryOutputsAreSignsAndStayWhereTheSumIsZero) {
  // s = (V1 - 1, V0, 0): neuron 0 down from anywhere but V1 = 1, where its sum is zero.
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(3, 3);
  W(0, 1) = W(1, 0) = 1;
  const Network net = network_of(W, Eigen::Vector3d(-1, 0, 0));
  const auto rest = [&](double V0, double V1, double V2) {
    return relax(net, one_by_one(3), Eigen::Vector3d(V0, V1, V2), 0, 10, {Neuron::binary}).V;
  };
  EXPECT_EQ(rest(0.5, 0.25, -0.375), Eigen::Vector3d(-1, -1, -0.375));
  EXPECT_EQ(rest(1, 1, 0), Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(rest(-0.5, 1, 1), Eigen::Vector3d(-1, -1, 1));
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

} // namespace
} // namespace hopmesh::tests
