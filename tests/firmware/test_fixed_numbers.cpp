// Whole numbers as fractions: shifts, the reciprocal root, lengths and directions, against double and by
// hand.
extern "C" {
#include "firmware/fixed/fixed_numbers.h"
}

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace hopmesh::tests {
namespace {

/// Squares of all sizes below 2^62: powers of two, their neighbours, and random ones.
std::vector<std::uint64_t> squares() {
  std::vector<std::uint64_t> all;
  for (int k = 0; k < 62; ++k)
    for (const std::int64_t beside : {-1, 0, 1})
      all.push_back(std::max<std::uint64_t>(1, (std::uint64_t{1} << k) + static_cast<std::uint64_t>(beside)));
  std::mt19937_64 random(20260816);
  for (int k = 0; k < 20000; ++k) all.push_back(std::max<std::uint64_t>(1, random() >> (2 + random() % 62)));
  return all;
}

TEST(FixedNumbers, TheFirstGuessIsTheMiddlesRoot) {
  for (int k = 0; k < 192; ++k)
    EXPECT_EQ(hm_first_inverse[k], std::lround(32768 / std::sqrt((64 + k + 0.5) / 256))) << k;
}

TEST(FixedNumbers, AReciprocalRootIsNear) {
  for (const std::uint64_t square : squares()) {
    const hm_root root = hm_root_of(square);
    const long double x = root.mantissa / 0x1p32L, y = root.inverse / 0x1p30L;
    ASSERT_GE(x, 0.25L) << square;
    ASSERT_GE(root.half, 1u);
    ASSERT_LE(root.half, 31u);
    EXPECT_LE(y, 1 / std::sqrt(x)) << square;
    EXPECT_GT(y, 1 / std::sqrt(x) * (1 - 0x1p-27L)) << square;
    EXPECT_LE(std::ldexp(static_cast<long double>(root.mantissa), 32 - 2 * static_cast<int>(root.half)),
              static_cast<long double>(square));
  }
}

TEST(FixedNumbers, ALengthIsToNearest) {
  for (const std::uint64_t square : squares()) {
    const hm_root root = hm_root_of(square);
    const long double wanted = std::sqrt(static_cast<long double>(square));
    EXPECT_NEAR(hm_length_of(&root), wanted, 0.5L + wanted * 0x1p-27L) << square;
  }
}

TEST(FixedNumbers, ADirectionHasLengthOneAndNoComponentAbove) {
  std::mt19937_64 random(20260817);
  for (int k = 0; k < 20000; ++k) {
    const int down = 2 + static_cast<int>(random() % 28);
    std::int32_t v[3];
    for (std::int32_t& x : v) x = static_cast<std::int32_t>(random()) >> down;
    if (k % 5 == 0) v[1] = v[2] = 0;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
    const hm_root root = hm_root_of(hm_square_of(hm_triple_at(v)));
    const double length = std::sqrt(double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2]);
    for (const std::int32_t x : v) {
      const std::int32_t along = hm_along(&root, x);
      ASSERT_LE(std::abs(along), 1 << 29);
      EXPECT_NEAR(along, x / length * 0x1p29, 16) << v[0] << ' ' << v[1] << ' ' << v[2];
    }
  }
}

TEST(FixedNumbers, AShiftRoundsDownWordByWord) {
  std::mt19937_64 random(20260818);
  for (std::uint32_t places = 0; places < 64; ++places)
    for (int k = 0; k < 200; ++k) {
      const auto a = static_cast<std::int64_t>(random());
      EXPECT_EQ(hm_shifted(a, places), a >> places);
    }
  EXPECT_EQ(hm_shifted(-1, 63), -1);
}

TEST(FixedNumbers, RoundsToNearest) {
  EXPECT_EQ(hm_rounded_down(7, 2), 2);
  EXPECT_EQ(hm_rounded_down(6, 2), 2); // a tie goes up
  EXPECT_EQ(hm_rounded_down(5, 2), 1);
  EXPECT_EQ(hm_rounded_down(-6, 2), -1);
  EXPECT_EQ(hm_rounded_down(-7, 2), -2);
  EXPECT_EQ(hm_rounded_down(INT32_MAX, 31), 1);
}

TEST(FixedNumbers, UpperWordsOfProducts) {
  EXPECT_EQ(hm_upper(1 << 30, 1 << 30), 1 << 28);
  EXPECT_EQ(hm_upper(-1, 1), -1);
  EXPECT_EQ(hm_upper_of(0xFFFFFFFFu, 0xFFFFFFFFu), 0xFFFFFFFEu);
}

} // namespace
} // namespace hopmesh::tests
