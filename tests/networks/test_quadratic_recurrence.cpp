// Each solver's first sweeps on two neurons, done by hand: W = -[[4, 1], [1, 2]], I = (1, 1), from V = 0; the
// answer is (1/7, 3/7).
#include "sim/networks/solvers/spectrum.h"
#include "tests/networks/quadratics.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace solvers;

Problem two_neurons() {
  return problem_of((Eigen::Matrix2d() << -4, -1, -1, -2).finished(), Vector::Ones(2), Vector::Zero(2));
}

void expect_after(const std::string& name, int sweeps, double first, double second,
                  double tolerance = 1e-15) {
  const Problem p = two_neurons();
  const Vector V = after(name, p, sweeps);
  EXPECT_NEAR(V[0], first, tolerance) << name << " after " << sweeps;
  EXPECT_NEAR(V[1], second, tolerance) << name << " after " << sweeps;
}

// N = (6, 4). The second neuron already sees the first one's answer: s = 1 - 1/6.
TEST(QuadraticRecurrence, HopfieldOneByOne) {
  const double a = 1. / 6, b = 5. / 24, a2 = a + 5. / 6 * (1 - 4 * a - b) / 6;
  for (const char* name : {"hopfield_sequential", "hopfield_coloured"}) {
    expect_after(name, 1, a, b);
    expect_after(name, 2, a2, b + 19. / 24 * (1 - a2 - 2 * b) / 4);
  }
}

// s = (1 - 4/6 - 1/4, 1 - 1/6 - 2/4) in the second sweep: both up, so R = 1 - V.
TEST(QuadraticRecurrence, HopfieldAllAtOnce) {
  expect_after("hopfield_synchronous", 1, 1. / 6, 1. / 4);
  expect_after("hopfield_synchronous", 2, 1. / 6 + 5. / 6 * (1. / 12) / 6, 1. / 4 + 3. / 4 * (1. / 3) / 4);
  expect_after("hopfield_damped", 1, 1. / 12, 1. / 8);
}

// Down, the room is 1 + V: from V = (1/2, 0), s = (-1, 1/2).
TEST(QuadraticRecurrence, HopfieldDownwards) {
  Problem p = two_neurons();
  p.start << 0.5, 0;
  const Vector V = after("hopfield_synchronous", p, 1);
  EXPECT_NEAR(V[0], 0.5 - 1.5 / 6, 1e-15);
  EXPECT_NEAR(V[1], 0.5 / 4, 1e-15);
}

TEST(QuadraticRecurrence, ExactSteps) {
  expect_after("gauss_seidel", 1, 1. / 4, 3. / 8);
  expect_after("gauss_seidel", 2, 5. / 32, 27. / 64);
  for (const char* name : {"sor_1.8_sequential", "sor_1.8_by_component"}) {
    expect_after(name, 1, 0.45, 0.495);
    expect_after(name, 2, 0.45 - 1.8 * 1.295 / 4, 0.495 + 0.9 * (1 + 0.13275 - 0.99));
  }
  expect_after("jacobi", 1, 1. / 4, 1. / 2);
  expect_after("jacobi", 2, 1. / 8, 3. / 8);
  expect_after("jacobi_damped", 1, 1. / 8, 1. / 4);
}

// Three neurons of components 0, 1, 0: the third fires before the second. H = [[1, 0, .5], [0, 1, .5], [.5,
// .5, 1]].
TEST(QuadraticRecurrence, ComponentByComponent) {
  const Eigen::Matrix3d H = (Eigen::Matrix3d() << 1, 0, 0.5, 0, 1, 0.5, 0.5, 0.5, 1).finished();
  const Problem p = problem_of(-H, Eigen::Vector3d(0.1, 0.1, 0.1), Vector::Zero(3));
  const double first = 0.18, third = 1.8 * (0.1 - first / 2), second = 1.8 * (0.1 - third / 2);
  EXPECT_LT((after("sor_1.8_by_component", p, 1) - Eigen::Vector3d(first, second, third)).norm(), 1e-15);
  const double in_turn = 1.8 * (0.1 - (first + first) / 2);
  EXPECT_LT((after("sor_1.8_sequential", p, 1) - Eigen::Vector3d(first, first, in_turn)).norm(), 1e-15);
}

TEST(QuadraticRecurrence, ExactStepsStopAtTheBox) {
  Problem p = two_neurons();
  p.I << 8, -8; // alone, the first would go to 2; the second, seeing 1, to -4.5
  for (const char* name : {"gauss_seidel", "sor_1.8_sequential"})
    EXPECT_EQ(after(name, p, 1), Vector(Eigen::Vector2d(1, -1)));
}

// The largest eigenvalue is 3 + sqrt 2.
TEST(QuadraticRecurrence, CurvatureFromAbove) {
  const double L = largest_curvature(two_neurons());
  EXPECT_GT(L, 3 + std::sqrt(2.0));
  EXPECT_LT(L, 1.03 * (3 + std::sqrt(2.0)));
}

// t = 1, 1.618, ...: momentum comes in with the third step.
TEST(QuadraticRecurrence, AcceleratedGradient) {
  const Problem p = two_neurons();
  const double L = largest_curvature(p), t1 = (1 + std::sqrt(5.0)) / 2,
               t2 = (1 + std::sqrt(1 + 4 * t1 * t1)) / 2;
  const auto down = [&](const Eigen::Vector2d& V) {
    return Eigen::Vector2d(V[0] + (1 - 4 * V[0] - V[1]) / L, V[1] + (1 - V[0] - 2 * V[1]) / L);
  };
  const Eigen::Vector2d one = down({0, 0}), two = down(one), three = down(two + (t1 - 1) / t2 * (two - one));
  expect_after("accelerated_gradient", 1, one[0], one[1]);
  expect_after("accelerated_gradient", 2, two[0], two[1]);
  expect_after("accelerated_gradient", 3, three[0], three[1]);
}

// g = (-1, -1): g'g / g'Hg = 2/8; then two conjugate directions are all there are.
TEST(QuadraticRecurrence, ConjugateGradient) {
  expect_after("conjugate_gradient", 1, 0.25, 0.25);
  expect_after("conjugate_gradient", 2, 1. / 7, 3. / 7);
}

// (H + rho) x = I + rho V, price still 0; det = (4 + rho)(2 + rho) - 1.
TEST(QuadraticRecurrence, Admm) {
  for (const auto& [name, share] : {std::pair("admm_tenth", 0.1), {"admm_hundredth", 0.01}}) {
    const double rho = share * largest_curvature(two_neurons()), det = (4 + rho) * (2 + rho) - 1;
    const double a = (1 + rho) / det, b = (3 + rho) / det, p = 1 + rho * a, q = 1 + rho * b;
    expect_after(name, 1, a, b);
    expect_after(name, 2, ((2 + rho) * p - q) / det, ((4 + rho) * q - p) / det);
  }
}

// With the box in the way the price of what is cut off counts in the next solve.
TEST(QuadraticRecurrence, AdmmPaysForTheBox) {
  Problem p = problem_of(-Eigen::MatrixXd::Identity(1, 1), Vector::Constant(1, 4), Vector::Zero(1));
  const double rho = 0.1 * largest_curvature(p), x = 4 / (1 + rho), price = x - 1;
  EXPECT_EQ(after("admm_tenth", p, 1)[0], 1);
  EXPECT_GT((4 + rho * (1 - price)) / (1 + rho) + price, 1) << "the hand's second step";
  EXPECT_EQ(after("admm_tenth", p, 2)[0], 1);
}

TEST(QuadraticRecurrence, OneSolve) {
  expect_after("cholesky", 1, 1. / 7, 3. / 7);
  expect_after("projected_newton", 1, 1. / 7, 3. / 7);
}

} // namespace
} // namespace hopmesh::tests
