// SystemC's output stage in the loops of every output stage: all 8-bit states in every normaliser, then
// corners and random cases at 16, 24 and 32 bits in every rounding mode.
#include "rtl_model/systemc/output_stage.h"
#include "tests/support/output_stage_cases.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Normaliser;
using spec::Overflow;
using spec::Rounding;

void expect_clean(const StageTally& t) {
  EXPECT_EQ(t.mismatches, 0u) << t.first;
  EXPECT_EQ(t.out_of_range, 0u) << t.first;
  EXPECT_EQ(t.wrong_direction, 0u) << t.first;
}

/// The module behind the two calls that the loops make.
class StageUnderTest {
 public:
  explicit StageUnderTest(const spec::ArraySpec& array) : path_(array, 1, 3), stage_("stage", path_) {}
  std::int64_t normalise(std::int64_t s, std::int64_t n) {
    stage_.set_norm(n);
    stage_.normalise(s);
    return stage_.drive_raw();
  }
  std::int64_t output(std::int64_t v) {
    stage_.load(static_cast<std::int32_t>(v));
    stage_.find_change(stage_.drive_raw());
    stage_.publish();
    return stage_.state_raw();
  }

 private:
  const systemc::Datapath path_;
  systemc::OutputStage stage_;
};

spec::ArraySpec array_of(const spec::NumberFormat& stage, Normaliser normaliser) {
  spec::ArraySpec array = stage_array(stage);
  array.normaliser = normaliser;
  return array;
}

/// Normaliser and rounding are the parameters, so a failure names them.
class AllEightBitStates : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(AllEightBitStates, AgreeWithTheBitSerialNeuron) {
  const auto [normaliser, rounding] = GetParam();
  const auto array =
      array_of({8, 2, static_cast<Rounding>(rounding), Overflow::sat}, static_cast<Normaliser>(normaliser));
  StageUnderTest stage(array);
  const StageTally tally = run_all_8_bit_cases(
      array, [&](auto s, auto n) { return stage.normalise(s, n); }, [&](auto v) { return stage.output(v); });
  EXPECT_EQ(tally.cases, 135266175u);
  expect_clean(tally);
}

INSTANTIATE_TEST_SUITE_P(DividerAndReciprocal, AllEightBitStates,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(int(Rounding::rnd), int(Rounding::trn_zero))));

class WideStates : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(WideStates, CornersThenRandom) {
  const auto [width, normaliser, rounding] = GetParam();
  const std::uint64_t seed = 100 * width + 10 * normaliser + rounding, cases = 10000000 / 21 + 1;
  // A prescaled row is not divided, so its u may be out of range, and wrapping would turn the direction.
  const auto overflow =
      normaliser == static_cast<int>(Normaliser::prescaled) ? Overflow::sat : Overflow::wrap;
  const auto array =
      array_of({width, 2, static_cast<Rounding>(rounding), overflow}, static_cast<Normaliser>(normaliser));
  StageUnderTest stage(array);
  SCOPED_TRACE("seed " + std::to_string(seed));
  const StageTally tally = run_corners_then_random(
      array, seed, cases, [&](auto s, auto n) { return stage.normalise(s, n); },
      [&](auto v) { return stage.output(v); });
  EXPECT_EQ(tally.cases, cases);
  expect_clean(tally);
}

INSTANTIATE_TEST_SUITE_P(EveryMode, WideStates,
                         testing::Combine(testing::Values(16, 24, 32), testing::Range(0, 3),
                                          testing::Range(0, 7)));

} // namespace
} // namespace hopmesh::tests
