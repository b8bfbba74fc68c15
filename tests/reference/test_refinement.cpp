// Corrections of the reference by its own code, on small dense problems: how they contract, what the box and
// a relaxation that ended early do to them, and when they end.
#include "tests/reference/random_inputs.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

struct Quadratic {
  Network network;
  Order order;
};

/// H = A'A + a shift; the pull takes outputs to their bounds where it is large.
Quadratic convex(Random& random, Eigen::Index n, double pull) {
  Eigen::MatrixXd A(n, n);
  Vector I(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = random.between(-1, 1);
    I[i] = pull * random.between(-1, 1);
  }
  const Eigen::MatrixXd W = -(A.transpose() * A + Eigen::MatrixXd::Identity(n, n));
  Quadratic made{{W.sparseView(), I}, {}};
  for (Eigen::Index i = 0; i < n; ++i) made.order.push_back({static_cast<std::uint32_t>(i)});
  return made;
}

const NeuronRule gauss_seidel{Neuron::projected, 1};
const Stop early{1e-2, 1000};

TEST(Refinement, contractsByWhatARelaxationLeaves) {
  Random random(31);
  for (int k = 0; k < 20; ++k) {
    const Quadratic q = convex(random, 3 + k % 6, 0.2);
    const Eigen::MatrixXd W = q.network.W;
    const Vector answer = (-W).ldlt().solve(q.network.I), V0 = Vector::Zero(answer.size());
    const Relaxation first = relax(q.network, q.order, V0, early, gauss_seidel);
    double before = (first.V - answer).norm();
    EXPECT_GT(before, 1e-9);
    for (std::uint32_t n = 1; n <= 4; ++n) {
      Relaxation corrected = first;
      const Refinement made = refine(q.network, q.order, V0, early, gauss_seidel, n, corrected);
      EXPECT_EQ(made.corrections, n);
      EXPECT_EQ(made.refused, 0u);
      EXPECT_GT(corrected.sweeps, first.sweeps);
      EXPECT_LT((corrected.V - answer).norm(), 0.3 * before) << k << ", correction " << n;
      const double whole = q.network.I.cwiseAbs().maxCoeff();
      EXPECT_NEAR(made.residual, (W * corrected.V + q.network.I).cwiseAbs().maxCoeff() / whole,
                  1e-9 * made.residual + 1e-15);
      before = (corrected.V - answer).norm();
    }
  }
}

// Where nothing is left but the rounding of doubles, nothing gets worse, and nothing counts as refused.
TEST(Refinement, staysAtTheLastPlaces) {
  Random random(32);
  for (int k = 0; k < 20; ++k) {
    const Quadratic q = convex(random, 3 + k % 6, 0.2);
    Relaxation answer = relax(q.network, q.order, Vector::Zero(q.network.I.size()), early, gauss_seidel);
    const Refinement made =
        refine(q.network, q.order, Vector::Zero(q.network.I.size()), early, gauss_seidel, 60, answer);
    EXPECT_EQ(made.refused, 0u);
    EXPECT_LT(made.residual, 1e-14);
  }
}

// With the box active the KKT point is the limit, and nothing leaves the box on the way.
TEST(Refinement, findsTheLeastInTheBox) {
  Random random(33);
  int held = 0;
  for (int k = 0; k < 30; ++k) {
    const Quadratic q = convex(random, 3 + k % 6, 6);
    const Vector V0 = Vector::Zero(q.network.I.size());
    Relaxation answer = relax(q.network, q.order, V0, early, gauss_seidel);
    const Refinement made = refine(q.network, q.order, V0, early, gauss_seidel, 60, answer);
    EXPECT_LE(answer.V.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT(kkt_violation(q.network, answer.V), 1e-12) << k;
    EXPECT_LT(made.residual, 1e-11) << k;
    held += static_cast<int>((answer.V.cwiseAbs().array() >= 1).count());
  }
  EXPECT_GT(held, 10);
}

// A saddle has no least between its bounds: what would climb is refused, and the answer before it stays.
TEST(Refinement, neverClimbs) {
  Random random(34);
  for (int k = 0; k < 40; ++k) {
    Quadratic q = convex(random, 4, 0.5);
    for (Eigen::Index i = 0; i < 2; ++i) q.network.W.coeffRef(i, i) *= -1;
    const Vector V0 = Vector::Zero(4);
    Relaxation answer = relax(q.network, q.order, V0, {0.5, 3}, {});
    double before = network_energy(q.network, answer.V);
    for (int n = 0; n < 6; ++n) {
      refine(q.network, q.order, V0, {0.5, 3}, {}, 1, answer);
      const double now = network_energy(q.network, answer.V);
      EXPECT_LE(now, before + 1e-12);
      before = now;
    }
  }
}

} // namespace
} // namespace hopmesh::tests
