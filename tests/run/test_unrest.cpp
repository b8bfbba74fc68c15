// Steps that did not come to rest are told in the sentence of a run.
#include "sim/run/unrest.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

run::StepRows rested(std::size_t steps) {
  run::StepRows rows(steps);
  for (levels::StepRow& row : rows) row.sweeps = 5, row.converged = true;
  return rows;
}

TEST(Unrest, IsNotTalkedOfWhereThereIsNone) {
  EXPECT_EQ(run::unrest_text(run::StepRows()), "");
  EXPECT_EQ(run::unrest_text(rested(3)), "");
  run::StepRows rivals(3); // no sweeps: nothing that could come to rest
  EXPECT_EQ(run::unrest_text(rivals), "");
}

TEST(Unrest, NamesStepsThatRanOutOfSweeps) {
  auto rows = rested(4);
  rows[1].converged = rows[3].converged = false;
  EXPECT_EQ(run::unrest_text(rows), "2 of 4 steps ended at max_sweeps.");
  EXPECT_TRUE(run::is_unrested(rows[1]));
  EXPECT_FALSE(run::is_unrested(rows[0]));
}

TEST(Unrest, NamesStepsThatCallThemselvesAtRestAndAreNot) {
  auto rows = rested(4);
  for (levels::StepRow& row : rows) row.fall_left = run::most_fall_left / 2, row.input_left = 1;
  EXPECT_EQ(run::unrest_text(rows), "") << "the fall is known, so the input says nothing";
  rows[2].fall_left = 0.33;
  EXPECT_EQ(run::unrest_text(rows), "1 of 4 steps left more than a tenth of their fall.");
  rows[2].converged = false;
  EXPECT_EQ(run::unrest_text(rows),
            "1 of 4 steps ended at max_sweeps, 1 of 4 steps left more than a tenth of their fall.");
}

TEST(Unrest, GoesByWhatTheHostSawWhereNobodyLookedForTheRest) {
  auto rows = rested(3);
  rows[0].fall_seen = 0.3, rows[1].fall_seen = 0.05;
  EXPECT_EQ(run::unrest_text(rows), "1 of 2 steps looked at left more than a tenth of their fall.");
  rows[2].converged = false;
  EXPECT_EQ(run::unrest_text(rows),
            "1 of 3 steps ended at max_sweeps, 1 of 2 steps looked at left more than a tenth of their fall.");
  rows[2].converged = true, rows[2].fall_seen = 0;
  EXPECT_EQ(run::unrest_text(rows), "1 of 3 steps left more than a tenth of their fall.");
  rows[0].fall_left = 0.02; // a network that is not definite has several rests
  EXPECT_EQ(run::unrest_text(rows), "");
}

TEST(Unrest, IsNotGuessedFromTheInput) {
  auto rows = rested(2);
  rows[0].input_left = 0.9;
  EXPECT_EQ(run::unrest_text(rows), "");
}

} // namespace
} // namespace hopmesh::tests
