// What a step leaves undone, on networks whose rest is known.
#include "sim/levels/left_over.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/reference/rest.h"
#include "tests/firmware/reference_pair.h"
#include "tests/support/small_scenes.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using reference::Network;
using reference::Vector;

// E = V^2 - V: it falls by 1/4 from 0 to its rest at 1/2.
const Network one_neuron{Eigen::MatrixXd::Constant(1, 1, -2).sparseView(), Vector::Constant(1, 1)};

double left_at(double V0, double V, const Network& network = one_neuron) {
  const Vector at = Vector::Constant(1, V);
  const reference::BlockNetwork blocks(network, 1);
  return levels::fall_left(blocks, Vector::Constant(1, V0), at, reference::rest_from(blocks, at).V);
}

TEST(LeftOver, FallIsThatOfTheParabola) {
  EXPECT_NEAR(left_at(0, 0), 1, 1e-15);
  EXPECT_NEAR(left_at(0, 0.25), 0.25, 1e-15);
  EXPECT_NEAR(left_at(0, 0.5), 0, 1e-15);
  EXPECT_NEAR(left_at(1, 0.25), 0.25, 1e-15) << "as high as 0";
  EXPECT_NEAR(left_at(0.25, 0.25), 1, 1e-15) << "nothing was done";
  EXPECT_NEAR(left_at(-1, 0.25), 0.25 / 9, 1e-15) << "3/2 away from rest, 9 times as high as 0";
}

// A warm start begins near rest: a last place away from it is nothing, whatever it is of the fall from there.
TEST(LeftOver, FallIsNotMeasuredAgainstALastPlace) {
  EXPECT_NEAR(left_at(0.5 + 1e-6, 0.5 + 1e-6), 4e-9, 1e-12);
}

TEST(LeftOver, NothingIsLeftWhereNothingFalls) {
  const Network none{Eigen::MatrixXd::Constant(1, 1, -2).sparseView(), Vector::Zero(1)};
  EXPECT_EQ(left_at(0, 0, none), 0);
  EXPECT_EQ(levels::input_left(none, Vector::Zero(1)), 0);
}

TEST(LeftOver, InputIsAShareOfTheBias) {
  EXPECT_EQ(levels::input_left(one_neuron, Vector::Zero(1)), 1);
  EXPECT_EQ(levels::input_left(one_neuron, Vector::Constant(1, 0.375)), 0.25);
  EXPECT_EQ(levels::input_left(one_neuron, Vector::Constant(1, 0.5)), 0);
  const Network outward{Eigen::MatrixXd::Constant(1, 1, -2).sparseView(), Vector::Constant(1, 5)};
  EXPECT_EQ(levels::input_left(outward, Vector::Ones(1)), 0) << "held by its bound";
}

// The firmware's rows and the reference's matrix are two layouts of one network.
TEST(LeftOver, FirmwareAndReferenceSayTheSame) {
  for (int seed = 1; seed <= 20; ++seed) {
    Dice dice(seed);
    Pair pair(random_scene_mesh(dice, seed % 2));
    const hm_mesh& mesh = pair.firmware.mesh;
    std::vector<double> predicted;
    for (const auto& x : pair.scene.position) predicted.insert(predicted.end(), x.begin(), x.end());
    hm_network network = pair.firmware.network;
    Vector V = Vector::Zero(pair.reference_size());
    for (std::uint32_t c = 0; c < mesh.cells; ++c)
      for (std::uint32_t p = 0; p < mesh.components; ++p)
        V[pair.reference_index(c, p)] = network.output[c * mesh.components + p] =
            dice.one_in(4) ? 1.0 : dice.unit() - 0.5;
    hm_network_build_incremental(&mesh, predicted.data(), 0.5, 0.1, &network);
    reference::Increment about{Eigen::Map<Vector>(predicted.data(), Eigen::Index(predicted.size())), 0.5,
                               0.1};
    const Network same = reference::network(pair.scene, about, 1, V);
    EXPECT_NEAR(levels::input_left(mesh, network), levels::input_left(same, V), 1e-12) << "seed " << seed;
  }
}

/// A mesh's network in the firmware's own layout, of a random motion.
struct Loaded {
  Loaded(Dice& dice, bool planar) : scene(grid_scene(4, 5)) {
    scene.mesh.planar = planar;
    mesh.emplace(scene);
    const hm_mesh& m = mesh->firmware();
    weight.resize(hm_weight_count(&m)), bias.resize(hm_neuron_count(&m));
    for (const auto& x : mesh->mesh().position)
      for (const double place : x) predicted.push_back(place + 0.1 * (dice.unit() - 0.5));
    for (std::size_t k = 0; k < bias.size(); ++k) start.push_back(0.2 * (dice.unit() - 0.5));
    output = start;
    network = {weight.data(), bias.data(), output.data()};
    hm_network_build_incremental(&m, predicted.data(), 0.5, 0.1, &network);
  }
  scene::Scene scene;
  std::optional<levels::BuiltMesh> mesh;
  std::vector<double> weight, bias, predicted, start, output;
  hm_network network{};
};

// Incremental networks are definite: what was seen is there, and a look that goes far enough sees all.
TEST(LeftOver, TheHostSeesNoMoreThanIsLeft) {
  for (int seed = 1; seed <= 10; ++seed) {
    Dice dice(seed);
    Loaded loaded(dice, seed % 2);
    const auto n = static_cast<Eigen::Index>(loaded.mesh->components());
    levels::LeftOver left(*loaded.mesh);
    const Vector V0 = levels::vector_of(loaded.start);
    reference::Network network{reference::Matrix(V0.size(), V0.size()), levels::vector_of(loaded.bias)};
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<std::size_t> cell_of_node(loaded.mesh->nodes());
    for (std::size_t c = 0; c < loaded.mesh->cells(); ++c) cell_of_node[loaded.mesh->node_of_cell(c)] = c;
    const auto by_cell = [&](std::size_t k) {
      return static_cast<int>(cell_of_node[k / static_cast<std::size_t>(n)]) * static_cast<int>(n) +
             static_cast<int>(k % static_cast<std::size_t>(n));
    };
    loaded.mesh->each_weight([&](std::size_t at, std::size_t row, std::size_t column) {
      entries.emplace_back(by_cell(row), by_cell(column), loaded.weight[at]);
    });
    network.W.setFromTriplets(entries.begin(), entries.end());
    const reference::BlockNetwork blocks(network, n);
    const Vector rest = reference::rest_from(blocks, V0).V;
    const Vector part = V0 + 0.5 * (rest - V0); // a quarter of the fall is left
    std::copy(part.begin(), part.end(), loaded.output.begin());
    EXPECT_NEAR(levels::fall_left(blocks, V0, part, rest), 0.25, 1e-9);
    const double seen = left.look(loaded.network, loaded.start, 0);
    EXPECT_LE(seen, 0.25 + 1e-9) << "seed " << seed;
    EXPECT_GT(seen, 0.1) << "seed " << seed;
    EXPECT_NEAR(left.look(loaded.network, loaded.start, 100'000), 0.25, 1e-3) << "seed " << seed;
  }
}

} // namespace
} // namespace hopmesh::tests
