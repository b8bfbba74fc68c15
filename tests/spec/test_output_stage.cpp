// The meaning of the output stage: a fast, straightforward integer version against the bit-serial one. All
// 8-bit states, then ten million 16-bit cases. Any other output stage is put into the same loops
// (tests/cosim).
#include "tests/support/output_stage_cases.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::NumberFormat;
using spec::Overflow;
using spec::Rounding;

std::int64_t floor_of(std::int64_t x, std::int64_t d) {
  return x >= 0 ? x / d : -((-x + d - 1) / d);
}
std::int64_t up_at_half(std::int64_t x, std::int64_t d) {
  return floor_of(2 * x + d, 2 * d);
}
std::int64_t down_at_half(std::int64_t x, std::int64_t d) {
  return -up_at_half(-x, d);
}

/// x / d as a whole number, by the textbook formula of each mode.
std::int64_t rounded(std::int64_t x, std::int64_t d, Rounding mode) {
  switch (mode) {
  case Rounding::rnd:
    return up_at_half(x, d);
  case Rounding::rnd_zero:
    return x >= 0 ? down_at_half(x, d) : up_at_half(x, d);
  case Rounding::rnd_min_inf:
    return down_at_half(x, d);
  case Rounding::rnd_inf:
    return x >= 0 ? up_at_half(x, d) : down_at_half(x, d);
  case Rounding::rnd_conv:
    return up_at_half(x, d) % 2 != 0 ? down_at_half(x, d) : up_at_half(x, d);
  case Rounding::trn:
    return floor_of(x, d);
  case Rounding::trn_zero:
    return x / d;
  }
  return 0;
}

class FastStage {
 public:
  explicit FastStage(const spec::ArraySpec& array)
      : rounding_(array.formats.drive.rounding), state_rounding_(array.formats.state.rounding),
        one_(array.formats.drive.one_raw()), reciprocal_bits_(array.reciprocal_bits),
        reciprocal_(array.normaliser == spec::Normaliser::reciprocal) {}

  std::int64_t normalise(std::int64_t s, std::int64_t n) {
    return u_ = reciprocal_ ? by_reciprocal(s, n) : rounded(s * one_, n, rounding_);
  }
  std::int64_t output(std::int64_t v) const {
    const std::int64_t r = u_ >= 0 ? one_ - v : one_ + v;
    return v + rounded(r * u_, one_, state_rounding_);
  }

 private:
  /// Small N only: every product stays within 63 bits.
  std::int64_t by_reciprocal(std::int64_t s, std::int64_t n) const {
    std::int64_t power = 1; // 2^B > N
    while (power <= n) power *= 2;
    const std::int64_t scale = power * (std::int64_t{1} << (reciprocal_bits_ - 2));
    return rounded(s * (scale / n) * one_, scale, rounding_);
  }

  Rounding rounding_, state_rounding_;
  std::int64_t one_;
  int reciprocal_bits_;
  bool reciprocal_;
  std::int64_t u_ = 0;
};

void expect_clean(const StageTally& t, std::uint64_t cases) {
  EXPECT_EQ(t.cases, cases);
  EXPECT_EQ(t.mismatches, 0u) << t.first;
  EXPECT_EQ(t.out_of_range, 0u) << t.first;
  EXPECT_EQ(t.wrong_direction, 0u) << t.first;
}

void run_exhaustive(const spec::ArraySpec& array) {
  FastStage fast(array);
  expect_clean(run_all_8_bit_cases(
                   array, [&](auto s, auto n) { return fast.normalise(s, n); },
                   [&](auto v) { return fast.output(v); }),
               135266175u);
}

TEST(OutputStage, AllEightBitStatesDivider) {
  run_exhaustive(stage_array({8, 2, Rounding::trn_zero, Overflow::sat}));
}

TEST(OutputStage, AllEightBitStatesReciprocal) {
  spec::ArraySpec array = stage_array({8, 2, Rounding::trn_zero, Overflow::sat});
  array.normaliser = spec::Normaliser::reciprocal;
  array.reciprocal_bits = 12;
  run_exhaustive(array);
}

TEST(OutputStage, AllEightBitPairsOfVAndDriveInEveryPairOfModes) {
  // u = s / 64 exactly, so every drive code occurs; the state's mode decides the rest.
  for (int q = 0; q < 7; ++q)
    for (int o = 0; o < 4; ++o) {
      const auto array = stage_array({8, 2, static_cast<Rounding>(q), static_cast<Overflow>(o)});
      FastStage fast(array);
      StageJudge judge(array);
      for (std::int64_t s = -64; s <= 64; ++s) {
        judge.drive_for(s, 64);
        const std::int64_t u = fast.normalise(s, 64);
        EXPECT_EQ(u, s);
        for (std::int64_t v = -64; v <= 64; ++v) judge.judge(v, u, fast.output(v));
      }
      expect_clean(judge.tally(), 129u * 129u);
    }
}

TEST(OutputStage, AllEightBitQuotientsInEveryMode) {
  for (int q = 0; q < 7; ++q) {
    const auto array = stage_array({8, 2, static_cast<Rounding>(q), Overflow::sat});
    FastStage fast(array);
    StageJudge judge(array);
    for (std::int64_t n = 1; n <= 1023; ++n)
      for (std::int64_t s = -n; s <= n; ++s)
        ASSERT_EQ(judge.drive_for(s, n), fast.normalise(s, n)) << s << " / " << n;
  }
}

/// The seed is the test's parameter, so a failure names it.
class OutputStage16 : public testing::TestWithParam<int> {};

TEST_P(OutputStage16, TenMillionCasesCornersFirst) {
  const std::uint64_t cases = 10000000 / 7 + 1, seed = 1600 + GetParam();
  const auto array = stage_array({16, 2, static_cast<Rounding>(GetParam()), Overflow::sat});
  FastStage fast(array);
  SCOPED_TRACE("seed " + std::to_string(seed));
  expect_clean(run_corners_then_random(
                   array, seed, cases, [&](auto s, auto n) { return fast.normalise(s, n); },
                   [&](auto v) { return fast.output(v); }),
               cases);
}

INSTANTIATE_TEST_SUITE_P(EveryRounding, OutputStage16, testing::Range(0, 7));

} // namespace
} // namespace hopmesh::tests
