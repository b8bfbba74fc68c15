// The problem set: what its networks are, what their least energies are, and that memories recall.
#include "sim/levels/networks/given_network.h"
#include "sim/networks/problems/making.h"
#include "tests/support/box_solver.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using problems::Problem;
using ::testing::HasSubstr;

double energy_of(const Problem& p, const std::vector<double>& V) {
  double energy = 0;
  for (const auto& e : p.W.entries) energy -= V[e.row] * e.value * V[e.column] / 2;
  for (std::size_t i = 0; i < V.size(); ++i) energy -= p.bias[i] * V[i];
  return energy;
}

reference::Order one_by_one(std::size_t neurons) {
  reference::Order order;
  for (std::size_t i = 0; i < neurons; ++i) order.push_back({static_cast<std::uint32_t>(i)});
  return order;
}

TEST(Problems, DiceFallAsSplitMix64) {
  problems::Dice dice(0); // published first numbers of that generator
  EXPECT_EQ(dice.next(), 0xe220a8397b1dcdafu);
  EXPECT_EQ(dice.next(), 0x6e789e6aa1b965f4u);
}

TEST(Problems, AreAtLeastTwentyAndReachAHundredThousandNeurons) {
  EXPECT_GE(problems::names().size(), 20u);
  std::size_t largest = 0;
  for (const std::string& name : problems::names()) {
    const Problem p = problems::make(name);
    EXPECT_EQ(p.name, name);
    EXPECT_EQ(p.bias.size(), p.W.rows) << name;
    EXPECT_EQ(p.start.size(), p.W.rows) << name;
    EXPECT_FALSE(problems::about(name).empty()) << name;
    largest = std::max(largest, p.W.rows);
  }
  EXPECT_EQ(largest, 100'000u);
}

TEST(Problems, AreSymmetricToTheLastBit) {
  for (const std::string& name : problems::names()) {
    const Problem p = problems::make(name);
    const levels::GivenNetwork network({p.W, p.bias, p.start}, 0);
    const reference::Matrix difference =
        network.network().W - reference::Matrix(network.network().W.transpose());
    EXPECT_EQ(difference.norm(), 0) << name;
    EXPECT_EQ(network.weights(), p.W.entries.size()) << name << ": zeros among the weights";
  }
}

TEST(Problems, TheSeedMovesTheStartAlone) {
  for (const char* name : {"memory-100", "cut-20", "queens-8"}) {
    const Problem a = problems::make(name, 1), again = problems::make(name, 1), b = problems::make(name, 2);
    EXPECT_EQ(a.start, again.start) << name;
    EXPECT_NE(a.start, b.start) << name;
    EXPECT_EQ(energy_of(a, a.start), energy_of(b, a.start)) << name;
  }
}

TEST(Problems, AnUnknownNameIsRefused) {
  EXPECT_THROW(problems::make("cut-17"), std::out_of_range);
}

TEST(Problems, EightQueensReachTheLeastEnergy) {
  const Problem p = problems::make("queens-8");
  std::vector<double> V(64, -1.0);
  for (const std::size_t square : {0, 12, 23, 29, 34, 46, 49, 59}) V[square] = 1; // a classical solution
  EXPECT_DOUBLE_EQ(energy_of(p, V), *p.least_energy);
  EXPECT_EQ(p.verdict(V), "8 queens, 0 attacks: a solution");
  V[0] = -1; // a queen missing: its row and its column are empty, 1 each
  EXPECT_DOUBLE_EQ(energy_of(p, V), *p.least_energy + 2);
  EXPECT_THAT(p.verdict(V), HasSubstr("no solution"));
  V[0] = V[9] = 1; // two on a diagonal, and a column and a row with two
  EXPECT_GT(energy_of(p, V), *p.least_energy);
}

TEST(Problems, CutsCountEdges) {
  const Problem torus = problems::make("cut-torus-10000");
  std::vector<double> board(10'000);
  for (std::size_t i = 0; i < board.size(); ++i) board[i] = (i / 100 + i % 100) % 2 ? 1 : -1;
  EXPECT_DOUBLE_EQ(energy_of(torus, board), *torus.least_energy);
  EXPECT_EQ(torus.verdict(board), "20000 of 20000 edges cut");
  const Problem ring = problems::make("cut-ring-1001");
  std::vector<double> turns(1001);
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = i % 2 ? 1 : -1;
  EXPECT_DOUBLE_EQ(energy_of(ring, turns), *ring.least_energy);
  EXPECT_EQ(ring.verdict(turns), "1000 of 1001 edges cut");
}

TEST(Problems, KnownLeastEnergiesAreThoseOfBruteForce) {
  const Problem two = problems::make("two-neurons"), small_ring = problems::ring_cut(9, 1);
  EXPECT_EQ(least_at_corners(two.W, two.bias), *two.least_energy);
  EXPECT_EQ(least_at_corners(small_ring.W, small_ring.bias), *small_ring.least_energy);
  const Problem four = problems::queens(4, 1); // 2 solutions
  EXPECT_EQ(least_at_corners(four.W, four.bias), *four.least_energy);
}

// ---- the independent solver

TEST(BoxSolver, OneAndTwoOutputsByHand) {
  const files::SparseMatrix one{1, 1, {{0, 0, -2}}};
  EXPECT_DOUBLE_EQ(least_on_box(one, {1}, {0}).V[0], 0.5); // s = 1 - 2 V
  EXPECT_DOUBLE_EQ(least_on_box(one, {5}, {0}).V[0], 1);
  const files::SparseMatrix two{2, 2, {{0, 0, -2}, {0, 1, 1}, {1, 0, 1}, {1, 1, -2}}};
  const BoxAnswer answer = least_on_box(two, {0.25, 0.5}, {0, 0}); // (2a - b, 2b - a) = (1/4, 1/2)
  EXPECT_TRUE(answer.solved);
  EXPECT_NEAR(answer.V[0], 1.0 / 3, 1e-12);
  EXPECT_NEAR(answer.V[1], 5.0 / 12, 1e-12);
  EXPECT_NEAR(answer.energy, -(0.25 / 3 + 0.5 * 5 / 12) / 2, 1e-12); // at rest inside: -I'V / 2
}

TEST(BoxSolver, ModifiedNetworksComeToTheSameAnswer) {
  for (const char* name : {"box-random-100", "box-membrane-100", "box-membrane-1024", "box-random-1000"}) {
    const Problem p = problems::make(name);
    const levels::GivenNetwork network({p.W, p.bias, p.start}, 0);
    const auto rest =
        reference::relax(network.network(), one_by_one(p.W.rows), network.start(), 1e-12, 1'000'000);
    const BoxAnswer answer = least_on_box(p.W, p.bias, p.start);
    EXPECT_TRUE(rest.converged && answer.solved) << name;
    const double energy = reference::network_energy(network.network(), rest.V);
    EXPECT_NEAR(energy, answer.energy, 1e-7 * std::abs(answer.energy)) << name;
    EXPECT_GE(energy, answer.energy - 1e-10 * std::abs(answer.energy)) << name << ": below the least";
  }
}

// ---- memories

class Memory : public ::testing::TestWithParam<const char*> {
 protected:
  static double overlap(const std::vector<double>& pattern, const reference::Vector& V) {
    double sum = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) sum += pattern[i] * V[static_cast<Eigen::Index>(i)];
    return sum / static_cast<double>(pattern.size());
  }

  /// The pattern with a tenth of its signs turned, relaxed neuron by neuron.
  static double recalled(const levels::GivenNetwork& network, const std::vector<double>& pattern,
                         problems::Dice& dice) {
    reference::Vector start =
        Eigen::Map<const reference::Vector>(pattern.data(), static_cast<Eigen::Index>(pattern.size()));
    for (double& v : start)
      if (dice.unit() < 0.1) v = -v;
    const auto rest = reference::relax(network.network(), one_by_one(pattern.size()), start, 0, 200,
                                       {reference::Neuron::binary});
    EXPECT_TRUE(rest.converged);
    return overlap(pattern, rest.V);
  }
};

// A tenth of n patterns: Hebb's rule recalls each with a few signs wrong, the projection exactly.
TEST_P(Memory, RecallsATenthOfNPatterns) {
  const std::string name = GetParam();
  const Problem p = problems::make(name);
  const levels::GivenNetwork network({p.W, p.bias, p.start}, 1);
  problems::Dice dice(20261124);
  double sum = 0, least = 1;
  for (std::uint64_t k = 1; k <= p.W.rows / 10; ++k) {
    const double m = recalled(network, problems::pattern_of(name, k), dice);
    least = std::min(least, m);
    sum += m;
  }
  const double mean = sum / (static_cast<double>(p.W.rows) / 10);
  const bool exact = name == "memory-1000-projection";
  EXPECT_GE(least, exact ? 1 : 0.95);
  EXPECT_GE(mean, exact ? 1 : 0.99);
  std::printf("%s: overlaps at least %.3f, on average %.4f\n", name.c_str(), least, mean);
}

INSTANTIATE_TEST_SUITE_P(Of, Memory, ::testing::Values("memory-1000", "memory-1000-projection"),
                         [](const auto& made) {
                           return std::string(made.param).size() > 12 ? "Projection" : "Hebb";
                         });

} // namespace
} // namespace hopmesh::tests
