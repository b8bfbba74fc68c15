// The fast twin against the readable reference: the same inputs, the same sweeps, whatever the order.
#include "sim/reference/block_sweeps.h"
#include "tests/reference/flags.h"
#include "tests/reference/random_inputs.h"
#include "tests/reference/vectors.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

constexpr double rounding = 1e-13; // of outputs up to 1, after some sweeps of some dozen terms

/// Component by component of every other node, then of those between: as a coloured array fires a ring.
Order by_parity(std::uint32_t nodes, std::uint32_t n) {
  Order order(2 * n);
  for (std::uint32_t node = 0; node < nodes; ++node)
    for (std::uint32_t p = 0; p < n; ++p) order[node % 2 * n + p].push_back(node * n + p);
  return order;
}

Order all_together(Eigen::Index neurons) {
  Order order(1);
  for (Eigen::Index k = 0; k < neurons; ++k) order[0].push_back(static_cast<std::uint32_t>(k));
  return order;
}

Vector swept(const BlockNetwork& twin, const Order& order, const Vector& V, std::uint32_t sweeps) {
  return BlockSweeps(twin, order).swept(V, sweeps);
}

void expect_twins(const Network& network, Eigen::Index n, const Order& order, const Vector& V) {
  const BlockNetwork twin(network, n);
  for (const std::uint32_t sweeps : {1u, 2u, 7u}) {
    const Vector wanted = relax(network, order, V, -1, sweeps).V, found = swept(twin, order, V, sweeps);
    EXPECT_LT(difference(found, wanted), rounding) << sweeps << " sweeps";
    EXPECT_LE(found.cwiseAbs().maxCoeff(), 1);
  }
}

TEST(BlockNetwork, SweepsRandomNetworksAsTheReadableReferenceDoes) {
  Random random(811);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Index n = 1 + random.below(12);
    const Network network = random_network(random, n);
    const Vector V = random_point(random, n);
    expect_twins(network, 1, one_by_one(n), V);
    expect_twins(network, 1, coloured(network.W), V);
    expect_twins(network, 1, all_together(n), V);
  }
}

TEST(BlockNetwork, SweepsMeshesAsTheReadableReferenceDoes) {
  Random random(812);
  for (int k = 0; k < 60; ++k) {
    const bool planar = random.chance(0.5);
    const scene::Mesh mesh = random_mesh(random, 2 + random.below(9), planar);
    const StepParameters motion = random_motion(random);
    const Vector C = initial_state(mesh).position, V = random_outputs(random, mesh);
    const Network net = network(mesh, motion, C, V);
    const Eigen::Index n = components(mesh);
    expect_twins(net, n, one_by_one(V.size()), V);
    expect_twins(net, n, all_together(V.size()), V);
    // Nodes of a phase may share weights here: then all of them read first.
    expect_twins(net, n, by_parity(static_cast<std::uint32_t>(mesh.nodes()), static_cast<std::uint32_t>(n)),
                 V);
  }
}

TEST(BlockNetwork, SweepsAFlagForAWholeStep) {
  const scene::Mesh mesh = flag(6, 7);
  StepParameters motion = flying();
  State state = initial_state(mesh);
  Order order; // four colours: rows and columns, even and odd
  for (std::uint32_t colour = 0; colour < 4; ++colour)
    for (std::uint32_t p = 0; p < 3; ++p) {
      order.emplace_back();
      for (std::uint32_t node = 0; node < mesh.nodes(); ++node)
        if (node / 7 % 2 * 2 + node % 7 % 2 == colour && !mesh.pinned[node])
          order.back().push_back(3 * node + p);
    }
  for (int k = 0; k < 5; ++k) {
    const Step step = advance(mesh, motion, order, state);
    const BlockNetwork twin(step.network, 3);
    EXPECT_LT(difference(swept(twin, order, step.V0, step.relaxation.sweeps), step.relaxation.V), 1e-12);
  }
}

TEST(BlockNetwork, InputsAreWVPlusI) {
  Random random(813);
  for (int k = 0; k < 100; ++k) {
    const scene::Mesh mesh = random_mesh(random, 2 + random.below(9), random.chance(0.5));
    const Vector V = random_outputs(random, mesh);
    const Network net = network(mesh, random_motion(random), initial_state(mesh).position, V);
    const BlockNetwork twin(net, components(mesh));
    Quads s(twin.nodes());
    twin.inputs(twin.bias(), twin.spread(V), s);
    const double largest = twin.gathered(twin.magnitude()).maxCoeff() + net.I.cwiseAbs().maxCoeff();
    EXPECT_LT(difference(twin.gathered(s), net.W * V + net.I), 1e-14 * largest);
  }
}

std::vector<const BlockKernel*> runnable_kernels() {
  std::vector<const BlockKernel*> kernels{&block_kernel()};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&avx2_kernel);
#endif
  return kernels;
}

TEST(BlockNetwork, EveryKernelGivesTheSameBits) {
  Random random(814);
  for (int k = 0; k < 60; ++k) {
    const scene::Mesh mesh = random_mesh(random, 2 + random.below(9), random.chance(0.5));
    const Vector V = random_outputs(random, mesh);
    const Network net = network(mesh, random_motion(random), initial_state(mesh).position, V);
    const Eigen::Index n = components(mesh);
    const BlockNetwork plain(net, n, portable_kernel);
    for (const BlockKernel* kernel : runnable_kernels()) {
      const BlockNetwork wide(net, n, *kernel);
      const Order order = one_by_one(V.size());
      EXPECT_EQ(swept(plain, order, V, 9), swept(wide, order, V, 9)) << kernel->name;
      EXPECT_EQ(swept(plain, all_together(V.size()), V, 9), swept(wide, all_together(V.size()), V, 9));
    }
  }
}

// A mesh whose springs have moved has its weights in the same places, another mesh has not.
TEST(BlockNetwork, TakesOtherNetworksAsIfItWereNew) {
  Random random(815);
  const bool planar = random.chance(0.5);
  const scene::Mesh mesh = random_mesh(random, 8, planar), other = random_mesh(random, 8, planar);
  const StepParameters motion = random_motion(random);
  const Eigen::Index n = components(mesh);
  std::vector<Network> networks;
  for (const scene::Mesh* of : {&mesh, &mesh, &other, &mesh}) {
    const Vector V = random_outputs(random, *of);
    networks.push_back(network(*of, motion, initial_state(*of).position, V));
  }
  BlockNetwork taking(networks[0], n);
  for (const Network& net : networks) {
    taking.take(net);
    const Vector V = 0.5 * random_outputs(random, mesh);
    EXPECT_EQ(swept(taking, one_by_one(V.size()), V, 5),
              swept(BlockNetwork(net, n), one_by_one(V.size()), V, 5));
  }
}

TEST(BlockNetwork, RefusesABlockThatIsNotSymmetric) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Constant(4, 4, -1);
  const Vector I = Vector::Ones(4);
  EXPECT_NO_THROW(BlockNetwork(network_of(W, I), 2));
  W(0, 3) = -2; // W(1, 2) lies across from it in the block of the two nodes
  EXPECT_THROW(BlockNetwork(network_of(W, I), 2), std::logic_error);
  EXPECT_NO_THROW(BlockNetwork(network_of(W, I), 1));
}

TEST(BlockNetwork, ANetworkWithoutNeuronsIsOne) {
  const BlockNetwork twin({Matrix(0, 0), Vector(0)}, 3);
  EXPECT_EQ(swept(twin, {}, Vector(0), 5).size(), 0);
}

} // namespace
} // namespace hopmesh::tests
