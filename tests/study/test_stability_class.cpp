// A run made by hand for each class, and each border from both sides.
#include "sim/study/stability_class.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace study;

/// 40 steps of a swing: total energy 1, ten sweeps, at rest after each.
std::vector<levels::StepRow> swing() {
  std::vector<levels::StepRow> rows(40);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].step = k, rows[k].sweeps = 10, rows[k].converged = true;
    rows[k].kinetic = rows[k].energy = 0.5;
  }
  return rows;
}

const StabilityFacts plain{false, 100, 1.0};

TEST(StabilityClass, ASwingIsStable) {
  EXPECT_EQ(classify(swing(), plain), Stability::stable);
  EXPECT_EQ(classify({}, plain), Stability::stable);
}

TEST(StabilityClass, DivergedIsBlowUp) {
  EXPECT_EQ(classify(swing(), {true, 100, 1.0}), Stability::blow_up);
}

TEST(StabilityClass, EnergyGainIsAMultipleOfTheThirdQuarter) {
  auto rows = swing();
  for (std::size_t k = 30; k < 40; ++k) rows[k].kinetic = gain_factor - 0.5 + 0.01;
  EXPECT_EQ(classify(rows, plain), Stability::energy_gain);
  for (std::size_t k = 30; k < 40; ++k) rows[k].kinetic = gain_factor - 0.5 - 0.01;
  EXPECT_EQ(classify(rows, plain), Stability::stable);
}

TEST(StabilityClass, UnfinishedIsALimitCycleWhereItSwings) {
  auto rows = swing();
  for (levels::StepRow& row : rows) row.converged = false, row.alternation = cycle_share + 0.01;
  EXPECT_EQ(classify(rows, plain), Stability::limit_cycle);
  for (levels::StepRow& row : rows) row.alternation = cycle_share - 0.01;
  EXPECT_EQ(classify(rows, plain), Stability::stable);
}

TEST(StabilityClass, MuchOfTheFallLeftIsFalselySoftWhateverEndedTheSteps) {
  for (const bool converged : {false, true}) {
    auto rows = swing();
    for (std::size_t k = 0; k < 20; ++k) rows[k].converged = converged, rows[k].fall_left = soft_share * 1.1;
    EXPECT_EQ(classify(rows, plain), Stability::stable) << "half is not most";
    rows[20].fall_left = soft_share * 1.1;
    EXPECT_EQ(classify(rows, plain), Stability::falsely_soft);
    for (levels::StepRow& row : rows) row.fall_left = soft_share * 0.9, row.converged = converged;
    EXPECT_EQ(classify(rows, plain), Stability::stable);
  }
}

TEST(StabilityClass, SaturatedIsMostOutputsInMostSteps) {
  auto rows = swing();
  for (levels::StepRow& row : rows) row.saturated = 50;
  EXPECT_EQ(classify(rows, plain), Stability::stable);
  for (levels::StepRow& row : rows) row.saturated = 51;
  EXPECT_EQ(classify(rows, plain), Stability::saturated);
}

TEST(StabilityClass, ALatticeStallRestsWithMostOfTheFallLeft) {
  auto rows = swing();
  for (levels::StepRow& row : rows) row.fall_left = stall_share * 1.1;
  EXPECT_EQ(classify(rows, plain), Stability::lattice_stall);
  for (levels::StepRow& row : rows) row.converged = false;
  EXPECT_EQ(classify(rows, plain), Stability::falsely_soft) << "starved, not stalled";
  for (levels::StepRow& row : rows) row.converged = true, row.fall_left = stall_share * 0.9;
  EXPECT_EQ(classify(rows, plain), Stability::falsely_soft);
}

TEST(StabilityClass, OverDampedDiesFasterThanFrictionExplains) {
  auto rows = swing();
  for (std::size_t k = 10; k < 40; ++k) rows[k].kinetic = 1e-4;
  EXPECT_EQ(classify(rows, plain), Stability::over_damped);
  EXPECT_EQ(classify(rows, {false, 100, 0.85}), Stability::stable) << "0.85^80 of the peak is less";
}

} // namespace
} // namespace hopmesh::tests
