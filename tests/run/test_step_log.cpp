// What is kept of a motion's steps: all of a short one, exact totals and an even choice of a long one.
#include "sim/run/step_log.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using levels::ReferenceError;
using levels::StepRow;
using levels::Summary;

StepRow row_of(std::uint64_t step) {
  StepRow row;
  row.step = step;
  row.sweeps = 1 + step % 10;
  row.cycles = step % 7 == 3 ? 500 : 100, row.bus_cycles = step % 7 == 3 ? 20 : 400;
  row.converged = step % 4 != 0;
  row.max_strain = static_cast<double>(step) / 8;
  row.error.emplace();
  row.error->rms_output = static_cast<double>(step % 5);
  return row;
}

run::StepLog log_of(std::uint64_t steps) {
  run::StepLog log;
  for (std::uint64_t k = 0; k < steps; ++k) log.push_back(row_of(k));
  return log;
}

TEST(StepLog, OfAShortMotionIsItsRows) {
  run::StepRows rows;
  for (std::uint64_t k = 0; k < 23; ++k) rows.push_back(row_of(k));
  const run::StepLog log = log_of(23);
  ASSERT_EQ(log.kept().size(), rows.size());
  EXPECT_EQ(log.kept()[22].step, 22u);
  EXPECT_EQ(log.stride(), 1u);
  for (const levels::StepColumn& column : run::step_columns())
    for (const Summary how : {Summary::sum, Summary::unmet, Summary::rms, Summary::median, Summary::largest})
      EXPECT_EQ(run::total_of(log, column.figure, how), run::total_of(rows, column.figure, how))
          << column.name;
  EXPECT_EQ(run::unrest_text(log), run::unrest_text(rows));
  EXPECT_EQ(log.slowest(), 520u);
}

TEST(StepLog, OfNoStepIsEmpty) {
  const run::StepLog log;
  EXPECT_TRUE(log.empty());
  EXPECT_FALSE(run::is_judged(log));
  EXPECT_EQ(run::total_of(log, &StepRow::sweeps, Summary::sum), 0);
  EXPECT_EQ(run::total_of(log, &StepRow::max_strain, Summary::rms), 0);
  EXPECT_EQ(run::unrest_text(log), "");
}

TEST(StepLog, OfAMillionStepsTakesBoundedRoomAndLosesNoTotal) {
  constexpr std::uint64_t steps = 1'000'000;
  const run::StepLog log = log_of(steps);
  EXPECT_EQ(log.size(), steps);
  EXPECT_LE(log.kept().size(), run::StepLog::most_kept);
  EXPECT_GT(log.kept().size(), run::StepLog::most_kept / 2 - 1);
  for (std::size_t k = 0; k < log.kept().size(); ++k) ASSERT_EQ(log.kept()[k].step, k * log.stride());
  EXPECT_EQ(log.back().step, steps - 1);
  EXPECT_EQ(run::count_of(log, &StepRow::sweeps, Summary::sum), steps / 10 * 55);
  EXPECT_EQ(run::count_of(log, &StepRow::converged, Summary::unmet), steps / 4);
  EXPECT_EQ(run::total_of(log, &StepRow::max_strain, Summary::largest), static_cast<double>(steps - 1) / 8);
  EXPECT_DOUBLE_EQ(run::total_of(log, &ReferenceError::rms_output, Summary::rms),
                   std::sqrt(6.0)); // 0 1 4 9 16
  EXPECT_EQ(run::total_of(log, &ReferenceError::rms_output, Summary::median), 2) << "of an even choice";
  EXPECT_EQ(run::unrest_text(log), "250,000 of 1,000,000 steps ended at max_sweeps.");
}

} // namespace
} // namespace hopmesh::tests
