// The judge's rest on the networks of all shipped scenes: by the readable reference's KKT measure, by its
// rule run until nothing moves, and by a factorisation, which tells how far a definite network's rest is.
#include "sim/input/shipped.h"
#include "sim/levels/prepared.h"
#include "sim/levels/reference_mover.h"
#include "sim/reference/block_sweeps.h"
#include "sim/reference/rest.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using reference::Vector;

constexpr double closeness = 1e-10; // of V
constexpr std::uint32_t patience = 4000;

double largest(const Vector& V) {
  return V.cwiseAbs().maxCoeff();
}

/// What is missing to the rest if no output comes to or leaves a bound: H^-1 s over those between them.
/// Fails where H is not positive definite.
Vector missing(const reference::Network& network, const Vector& V) {
  const Vector s = network.W * V + network.I;
  std::vector<Eigen::Triplet<double>> entries;
  Vector free_s = Vector::Zero(V.size());
  for (Eigen::Index i = 0; i < V.size(); ++i) {
    const bool free = std::abs(V[i]) < 1 && network.W.coeff(i, i) != 0;
    if (free) free_s[i] = s[i];
    if (!free) entries.emplace_back(i, i, 1);
    for (reference::Matrix::InnerIterator w(network.W, i); free && w; ++w)
      if (std::abs(V[w.col()]) < 1) entries.emplace_back(i, w.col(), -w.value());
  }
  Eigen::SparseMatrix<double> H(V.size(), V.size());
  H.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(H);
  EXPECT_GT(factor.vectorD().minCoeff(), 0);
  return factor.solve(free_s);
}

class RestOfScene : public ::testing::TestWithParam<std::string> {
 protected:
  void expect_rest(const reference::Network& network, const reference::Order& order, const Vector& start) {
    const reference::BlockNetwork twin(network, components);
    const reference::Rest rest = reference::rest_from(twin, start);
    EXPECT_TRUE(rest.found) << rest.violation;
    EXPECT_LT(reference::kkt_violation(network, rest.V), 1e-15);
    EXPECT_GE(reference::energy_above(twin, rest.V, start), 0);
    EXPECT_LT(largest(reference::relax(network, order, rest.V, 0, 20).V - rest.V), 1e-12)
        << "it does not stay";
    const Vector swept = reference::BlockSweeps(twin, order).swept(start, 50);
    EXPECT_LT(largest(swept - reference::relax(network, order, start, -1, 50).V), 1e-12);
    if (!definite) return;
    EXPECT_LT(largest(missing(network, rest.V)), closeness);
    EXPECT_LT(largest(reference::rest_from(twin, Vector::Zero(start.size())).V - rest.V), closeness);
    const reference::Relaxation slow = reference::relax(network, order, start, 1e-17, patience);
    if (slow.converged) {
      EXPECT_LT(largest(slow.V - rest.V), closeness);
    }
  }

  Eigen::Index components = 3;
  bool definite = false;
};

TEST_P(RestOfScene, IsTheReadableReferences) {
  levels::Prepared p;
  try {
    p = levels::prepare(GetParam(), "guarded", {"relax.max_sweeps=40", "relax.expansions=1"});
  } catch (const input::InputError& missing_mesh) {
    GTEST_SKIP() << missing_mesh.what();
  }
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  const reference::Order order = levels::order_for(*p.mesh, p.inputs.array.schedule);
  components = static_cast<Eigen::Index>(p.mesh->components());
  definite = motion.formulation().increment != nullptr;
  for (int step = 0; step < 5; ++step) {
    motion.advance();
    if (step % 2 == 0) expect_rest(motion.last_step().network, order, motion.last_step().V0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, RestOfScene,
                         ::testing::ValuesIn(input::shipped_names(input::Shipped::scene)),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

} // namespace
} // namespace hopmesh::tests
