// hm_codes_of_bits, the whole-number way from doubles to raw codes, against hm_code in every mode.
#include "firmware/quantise_whole.h"

#include "firmware/registers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace hopmesh::tests {
namespace {

/// Codes, how many were clipped and how many vanished: as value by value.
void expect_alike(const std::vector<double>& values, int shift, const hm_format& format) {
  const double scale = std::ldexp(1, shift);
  std::vector<std::uint32_t> words(values.size());
  const auto count = static_cast<std::uint32_t>(values.size());
  const std::uint32_t clipped = hm_codes_of_bits(values.data(), count, scale, &format, words.data());
  std::uint32_t wanted_clipped = 0, wanted_vanished = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    int beyond = 0;
    const std::int32_t wanted = hm_code(values[k] * scale, &format, &beyond);
    ASSERT_EQ(static_cast<std::int32_t>(words[k]), wanted)
        << std::hexfloat << values[k] << " * 2^" << std::dec << shift << " width " << format.width
        << " modes " << format.rounding << ' ' << format.overflow;
    wanted_clipped += static_cast<std::uint32_t>(beyond);
    wanted_vanished += values[k] != 0 && wanted == 0;
  }
  EXPECT_EQ(clipped, wanted_clipped);
  EXPECT_EQ(hm_vanished_by_bits(values.data(), words.data(), count), wanted_vanished);
}

template <typename Body> void for_every_format(Body body) {
  for (const int width : {2, 8, 16, 24, 31, 32})
    for (int rounding = HM_RND; rounding <= HM_TRN_ZERO; ++rounding)
      for (int overflow = HM_SAT; overflow <= HM_WRAP; ++overflow)
        body(hm_format{width, 1, rounding, overflow});
}

TEST(QuantiseWhole, EveryQuarterOfALastPlaceAndJustBesideIt) {
  std::vector<double> values;
  for (int quarter = -1100; quarter <= 1100; ++quarter)
    for (const double toward : {-1e9, quarter / 4.0, 1e9})
      values.push_back(std::nextafter(quarter / 4.0, toward));
  for_every_format([&](const hm_format& format) { expect_alike(values, 0, format); });
}

TEST(QuantiseWhole, EveryPowerOfTwoAndItsNeighboursAtEveryEndOfTheRange) {
  std::vector<double> values{0.0, -0.0, 0x1p-1074, -0x1p-1074, 0x1p-1022, 0x1.fffffffffffffp1023};
  for (int exponent = -80; exponent <= 90; ++exponent)
    for (const double sign : {-1.0, 1.0})
      for (const double mantissa : {1.0, 0x1.0000000000001p0, 0x1.fffffffffffffp0, 1.5, 0x1.00000001p0})
        values.push_back(sign * std::ldexp(mantissa, exponent));
  for_every_format([&](const hm_format& format) {
    for (const int shift : {-1000, -30, 0, 7, 30, 900}) expect_alike(values, shift, format);
  });
}

TEST(QuantiseWhole, RandomBitPatterns) {
  constexpr unsigned seed = 20260815;
  std::mt19937_64 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::vector<double> values;
  for (int k = 0; k < 4000; ++k) {
    std::uint64_t bits = random();
    if (k % 2 == 0) bits = (bits & ~(0x7FFull << 52)) | (1023 - 3 + random() % 40) << 52; // about the range
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  for_every_format([&](const hm_format& format) { expect_alike(values, 0, format); });
}

TEST(QuantiseWhole, KnowsAPowerOfTwo) {
  EXPECT_TRUE(hm_is_power_of_two(1));
  EXPECT_TRUE(hm_is_power_of_two(0x1p-1022));
  for (const double none : {0.0, -1.0, 3.0, 0x1p-1074, HUGE_VAL})
    EXPECT_FALSE(hm_is_power_of_two(none)) << none;
}

} // namespace
} // namespace hopmesh::tests
