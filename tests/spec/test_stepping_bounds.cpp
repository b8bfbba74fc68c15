// The bounds of docs/hardware/datapath.md for the stages that step further: |V|, |Y| <= 1 over all 8-bit V,
// Y, u and every rounding, with drives coarser and finer than the state; and which way a step goes.
#include "tests/support/stepping.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::NumberFormat;
using spec::Overflow;
using spec::Rounding;

/// Rounding of the state, and fraction bits of the drive: 4 fewer, as many, 3 more.
class SteppingBounds : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  SteppingBounds()
      : drive_(6 + std::get<1>(GetParam())),
        stage_(drive_, {8, 2, static_cast<Rounding>(std::get<0>(GetParam())), Overflow::wrap}) {}
  const int drive_;
  const Stepping stage_;
};

TEST_P(SteppingBounds, ProjectedStaysInTheBoxAndGoesWhereItsStepPoints) {
  const std::int64_t two = std::int64_t{2} << drive_;
  std::size_t at_a_bound = 0;
  for (std::int64_t u = -two; u <= two; ++u)
    for (std::int64_t V = -64; V <= 64; ++V) {
      const std::int64_t next = stage_.moved(V, u);
      ASSERT_LE(std::abs(next), 64) << V << " " << u;
      ASSERT_TRUE(u > 0   ? next >= V || stage_.step(u) < 0
                  : u < 0 ? next <= V || stage_.step(u) > 0
                          : next == V);
      at_a_bound += std::abs(next) == 64;
    }
  EXPECT_GT(at_a_bound, 129u);
  EXPECT_EQ(stage_.moved(-64, two), 64); // 2 reaches from bound to bound
}

TEST_P(SteppingBounds, MomentumKeepsBothPointsInTheBox) {
  const std::int64_t one = std::int64_t{1} << drive_;
  const std::int64_t few = drive_ > 6 ? 5 : 1; // every u, or every fifth of a fine drive
  for (std::int64_t Y = -64; Y <= 64; Y += 4)
    for (std::int64_t u = -one; u <= one; u += few) {
      const std::int64_t next = stage_.moved(Y, u);
      ASSERT_LE(std::abs(next), 64) << Y << " " << u;
      for (std::int64_t V = -64; V <= 64; V += 2)
        for (std::int64_t m : {-32768, -1, 0, 1, 9233, 16384, 32767})
          ASSERT_LE(std::abs(stage_.ahead(next, next - V, m)), 64) << V << " " << next << " " << m;
    }
}

/// All V, V' and m: what the host can write into the table does not matter.
TEST_P(SteppingBounds, NoTableLeavesTheBox) {
  if (std::get<1>(GetParam()) != 0) return; // no drive in it
  for (std::int64_t V = -64; V <= 64; ++V)
    for (std::int64_t next = -64; next <= 64; ++next)
      for (std::int64_t m = -32768; m <= 32767; m += 51)
        ASSERT_LE(std::abs(stage_.ahead(next, next - V, m)), 64) << V << " " << next << " " << m;
  EXPECT_EQ(stage_.ahead(10, 0, 32767), 10);  // at rest
  EXPECT_EQ(stage_.ahead(-10, 20, 0), -10);   // without momentum
  EXPECT_EQ(stage_.ahead(0, 32, 16384), 16);  // halfway on
  EXPECT_EQ(stage_.ahead(60, 64, 32767), 64); // no further than the bound
}

std::string name_of(const testing::TestParamInfo<std::tuple<int, int>>& info) {
  const char* const drives[] = {"coarser", "alike", "finer"};
  const int more = std::get<1>(info.param);
  return std::string(spec::rounding_names[std::get<0>(info.param)]) + "_" +
         drives[more < 0    ? 0
                : more == 0 ? 1
                            : 2];
}
INSTANTIATE_TEST_SUITE_P(EveryMode, SteppingBounds,
                         testing::Combine(testing::Range(0, 7), testing::Values(-4, 0, 3)), name_of);

} // namespace
} // namespace hopmesh::tests
