// Weights and bias as the firmware builds them, against the reference's, entry by entry.
#include "tests/firmware/reference_pair.h"

extern "C" {
#include "firmware/bus.h"
}

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// Column of the reference's W that the firmware's k-th tap of a cell's rows stands for.
Eigen::Index column(const Pair& pair, std::uint32_t cell, std::uint32_t k) {
  const hm_mesh& m = pair.firmware.mesh;
  const std::uint32_t block = k / m.components, p = k % m.components;
  return pair.reference_index(block == 0 ? cell : m.link_to[m.first_link[cell] + block - 1], p);
}

TEST(Network, IsTheReferencesEntryByEntry) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Dice dice(seed);
    Pair pair(random_scene_mesh(dice, dice.one_in(2)));
    hm_mesh& m = pair.firmware.mesh;
    hm_step_parameters motion{};
    motion.formulation = &hm_probe;
    motion.time_step = dice.one_in(2) ? 0.05 : 1.0, motion.beta = dice.one_in(4) ? 0.0 : dice.unit();
    const double dt = motion.time_step, h = dt * dt / 2;

    reference::Vector predicted(3 * pair.scene.nodes()), V0 = reference::Vector::Zero(pair.reference_size());
    for (Eigen::Index k = 0; k < predicted.size(); ++k)
      predicted[k] =
          pair.scene.position[k / 3][k % 3] + (pair.scene.pinned[k / 3] ? 0 : 0.1 * (dice.unit() - 0.5));
    for (std::uint32_t c = 0; c < m.cells; ++c)
      for (std::uint32_t p = 0; p < m.components; ++p)
        V0[pair.reference_index(c, p)] = pair.firmware.output[c * m.components + p] = 2 * dice.unit() - 1;
    const std::vector<double> before = pair.firmware.output;

    const reference::Network expected =
        reference::network(pair.scene, reference_motion(motion), predicted, V0);
    hm_network_build(&m, predicted.data(), h, motion.beta * dt * dt * dt * dt, &pair.firmware.network);

    EXPECT_EQ(pair.firmware.output, before);
    const double scale = expected.W.coeffs().cwiseAbs().maxCoeff();
    double sum = 0;
    for (std::uint32_t c = 0; c < m.cells; ++c)
      for (std::uint32_t p = 0; p < m.components; ++p) {
        for (std::uint32_t k = 0; k < hm_row_length(&m, c); ++k) {
          const double w = pair.firmware.weight[hm_row_offset(&m, c, p) + k];
          sum += std::abs(w);
          ASSERT_NEAR(w, expected.W.coeff(pair.reference_index(c, p), column(pair, c, k)), 1e-12 * scale)
              << "seed " << seed << ", cell " << c << ", component " << p << ", tap " << k;
        }
        const double bias_scale = std::max(scale, expected.I.cwiseAbs().maxCoeff());
        ASSERT_NEAR(pair.firmware.bias[c * m.components + p], expected.I[pair.reference_index(c, p)],
                    1e-12 * bias_scale)
            << "seed " << seed << ", cell " << c << ", component " << p;
      }
    EXPECT_NEAR(sum, expected.W.coeffs().cwiseAbs().sum(), 1e-10 * sum)
        << "seed " << seed; // nothing left out
  }
}

TEST(Network, OneSpringByHand) {
  // Free nodes 0 and 1, two apart along x, alpha 3, L = 1, h = 1, V0 = 0, beta 0.
  // w = (-1, 0, 0): S = 2 alpha h^2 (1 - L/l (1 - w w')) = diag(6, 3, 3); f = 2 alpha h (1 - L/l) u = (-6, 0,
  // 0).
  FirmwareMesh f({{0, 1, 3, 1}}, {false, false}, 3);
  ASSERT_EQ(hm_mesh_connect(&f.mesh), HM_OK);
  const double predicted[] = {0, 0, 0, 2, 0, 0};
  hm_network_build(&f.mesh, predicted, 1, 0, &f.network);
  EXPECT_EQ(f.weight, (std::vector<double>{-6, 0, 0, 6, 0, 0, 0, -3, 0, 0, 3, 0, 0, 0, -3, 0, 0, 3, //
                                           -6, 0, 0, 6, 0, 0, 0, -3, 0, 0, 3, 0, 0, 0, -3, 0, 0, 3}));
  EXPECT_EQ(f.bias, (std::vector<double>{6, 0, 0, -6, 0, 0}));
}

TEST(Network, ASpringOfNoLengthKeepsItsStiffness) {
  FirmwareMesh f({{0, 1, 3, 1}}, {false, true}, 3);
  ASSERT_EQ(hm_mesh_connect(&f.mesh), HM_OK);
  const double predicted[] = {5, 5, 5, 5, 5, 5};
  hm_network_build(&f.mesh, predicted, 1, 0, &f.network);
  EXPECT_EQ(f.weight, (std::vector<double>{-6, 0, 0, 0, -6, 0, 0, 0, -6}));
  EXPECT_EQ(f.bias, (std::vector<double>{0, 0, 0}));
}

TEST(Network, LayoutIsTheTopologys) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Dice dice(seed);
    const Pair pair(random_scene_mesh(dice, dice.one_in(2)));
    const hm_mesh& m = pair.firmware.mesh;
    spec::Topology t;
    t.neurons_per_cell = static_cast<int>(m.components);
    t.first_link.assign(m.first_link, m.first_link + m.cells + 1);
    t.link_to.assign(m.link_to, m.link_to + m.first_link[m.cells]);
    EXPECT_EQ(hm_weight_count(&m), t.weight_words());
    for (std::uint32_t c = 0; c < m.cells; ++c) {
      EXPECT_EQ(hm_row_length(&m, c), t.taps(c));
      for (std::uint32_t p = 0; p < m.components; ++p) EXPECT_EQ(hm_row_offset(&m, c, p), t.row_offset(c, p));
    }
  }
}

TEST(Network, ASpringWithoutALinkIsRefused) {
  FirmwareMesh f({{0, 1, 1, 1}, {1, 2, 1, 1}}, {false, false, false}, 3);
  EXPECT_EQ(hm_mesh_connect(&f.mesh), HM_OK);
  f.mesh.spring[1].node[0] = 0; // 0 - 2: these cells share no link
  EXPECT_EQ(hm_mesh_connect(&f.mesh), HM_ERROR_MESH);
}

} // namespace
} // namespace hopmesh::tests
