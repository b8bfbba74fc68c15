// Parts of an error, against sums done by hand.
#include "sim/study/budget/error_budget.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hopmesh::tests {
namespace {

using run::Positions;

// A single node. Whole: (3, 4, 0), 5 long. First part (3, 0, 0): projection 9/25. Second (0, 5, 0): 20/25.
// Third (0, -1, 0): -4/25.
TEST(ErrorBudget, ByHand) {
  const Positions run{3, 4, 0}, b{0, 4, 0}, c{0, -1, 0}, truth{0, 0, 0};
  const study::BudgetAt budget = study::budget_of({&run, &b, &c, &truth});
  EXPECT_DOUBLE_EQ(budget.total, 5);
  ASSERT_EQ(budget.parts.size(), 3u);
  EXPECT_DOUBLE_EQ(budget.parts[0].norm, 3);
  EXPECT_DOUBLE_EQ(budget.parts[0].share, 9.0 / 25);
  EXPECT_DOUBLE_EQ(budget.parts[1].norm, 5);
  EXPECT_DOUBLE_EQ(budget.parts[1].share, 20.0 / 25);
  EXPECT_DOUBLE_EQ(budget.parts[2].norm, 1);
  EXPECT_DOUBLE_EQ(budget.parts[2].share, -4.0 / 25);
}

// Two nodes, each off by 1: the rms over nodes is 1.
TEST(ErrorBudget, IsAMeanOverNodes) {
  const Positions run{1, 0, 0, 0, 1, 0}, truth(6, 0.0);
  EXPECT_DOUBLE_EQ(study::budget_of({&run, &truth}).total, 1);
}

TEST(ErrorBudget, OfNoErrorHasNoShares) {
  const Positions same{1, 2, 3}, other{1, 2, 4};
  const study::BudgetAt budget = study::budget_of({&same, &other, &same});
  EXPECT_EQ(budget.total, 0);
  EXPECT_EQ(budget.parts[0].share, 0);
  EXPECT_DOUBLE_EQ(budget.parts[0].norm, 1);
}

TEST(ErrorBudget, SharesAddUpToTheWhole) {
  const auto seed = std::random_device()();
  std::printf("seed %u\n", seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Positions> chain(5, Positions(30));
  for (Positions& p : chain)
    for (double& x : p) x = normal(random);
  const study::BudgetAt budget = study::budget_of({&chain[0], &chain[1], &chain[2], &chain[3], &chain[4]});
  double sum = 0;
  for (const auto& part : budget.parts) sum += part.share;
  EXPECT_NEAR(sum, 1, 1e-12);
}

} // namespace
} // namespace hopmesh::tests
