// hm_quantise, the firmware's way from a double to a raw code, against the bit-by-bit oracle in every mode.
#include "tests/support/random_network.h"
#include "tests/support/slow_fixed.h"

extern "C" {
#include "firmware/driver.h"
#include "firmware/registers.h"
}

#include <gtest/gtest.h>

#include <cmath>

namespace hopmesh::tests {
namespace {

using spec::NumberFormat;
using spec::Overflow;
using spec::Rounding;

hm_format firmware_format(const NumberFormat& f) {
  return {f.width, f.integer_bits, static_cast<int>(f.rounding), static_cast<int>(f.overflow)};
}

/// Code and clip flag against the oracle. Clipped: the value, rounded, did not fit.
void expect_code(double value, int shift, const NumberFormat& f, const std::string& where = "") {
  const hm_format format = firmware_format(f);
  NumberFormat roomy = f;
  roomy.width += 30;
  roomy.integer_bits += 30;
  roomy.overflow = Overflow::sat;
  const std::int64_t wanted = quantise_double(value, shift, f);
  int clipped = 0;
  ASSERT_EQ(hm_quantise(value, shift, &format, &clipped), wanted)
      << f.text() << " " << std::hexfloat << value << " * 2^" << std::dec << shift << " " << where;
  ASSERT_EQ(clipped != 0, quantise_double(value, shift, roomy) != wanted)
      << f.text() << " " << std::hexfloat << value << " * 2^" << std::dec << shift << " " << where;
}

template <typename Body> void for_every_mode(int width, int integer_bits, Body body) {
  for (int q = 0; q < 7; ++q)
    for (int o = 0; o < 4; ++o)
      body(NumberFormat{width, integer_bits, static_cast<Rounding>(q), static_cast<Overflow>(o)});
}

TEST(Quantise, EveryQuarterOfALastPlaceInAByte) {
  for_every_mode(8, 3, [](const NumberFormat& f) {
    for (int quarter = -1100; quarter <= 1100; ++quarter) expect_code(std::ldexp(quarter, -7), 0, f);
  });
}

TEST(Quantise, JustBesideEveryTie) {
  for_every_mode(8, 3, [](const NumberFormat& f) {
    for (int half = -260; half <= 260; ++half)
      for (double toward : {-1e9, 1e9}) expect_code(std::nextafter(std::ldexp(half, -6), toward), 0, f);
  });
}

TEST(Quantise, TinyAndHugeValues) {
  for_every_mode(16, 2, [](const NumberFormat& f) {
    for (double x : {0.0, 5e-324, 2.2250738585072014e-308, 1e-300, 1e-20, 0x1p-15, 0x1p-16})
      for (double sign : {1.0, -1.0}) expect_code(sign * x, 0, f);
    if (f.overflow == Overflow::wrap) return;
    for (double x : {1e10, 0x1p48, 1e19, 1e100, 1.7976931348623157e308})
      for (double sign : {1.0, -1.0}) expect_code(sign * x, 0, f);
  });
}

TEST(Quantise, HugeValuesKeepTheirLowBitsWhenTheyWrap) {
  // 2^52 + 1 times 2^k, counted in last places: its lowest set bit counts until it leaves the word.
  const NumberFormat f{16, 2, Rounding::trn, Overflow::wrap};
  for (int k = 0; k <= 40; ++k)
    for (double sign : {1.0, -1.0}) expect_code(sign * std::ldexp(0x1p52 + 1, k - 14), 0, f);
}

TEST(Quantise, HalvesFarBeyondTheFormatAreRoundedBeforeTheyWrap) {
  for_every_mode(32, 31, [](const NumberFormat& f) {
    for (int e = 30; e <= 52; ++e)
      for (double beside : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5})
        for (double sign : {1.0, -1.0}) expect_code(sign * (std::ldexp(1.0, e) + beside) / 2, 0, f);
  });
}

TEST(Quantise, ScalesByThePowerOfTwoExactly) {
  const NumberFormat f{16, 1, Rounding::rnd, Overflow::sat};
  for (int shift = -900; shift <= 900; shift += 7) expect_code(std::ldexp(0.7, -shift), shift, f);
}

TEST(Quantise, RandomValuesAndFormats) {
  const std::uint64_t seed = 31;
  Dice dice(seed);
  for (int k = 0; k < 300000; ++k) {
    NumberFormat f;
    f.width = static_cast<int>(dice.between(4, 32));
    f.integer_bits = static_cast<int>(dice.between(1, f.width - 1));
    f.rounding = dice.mode<Rounding>(spec::rounding_names);
    f.overflow = dice.mode<Overflow>(spec::overflow_names);
    const int scale = static_cast<int>(dice.between(-30, 5)), shift = static_cast<int>(dice.between(-40, 40));
    double value = std::ldexp(dice.unit() * 2 - 1, f.integer_bits + scale);
    if (dice.one_in(3))
      value = std::ldexp(std::round(std::ldexp(value, f.fraction_bits() + 1)), -f.fraction_bits() - 1);
    expect_code(std::ldexp(value, -shift), shift, f,
                "seed " + std::to_string(seed) + ", case " + std::to_string(k));
    if (HasFatalFailure()) return;
  }
}

/// Codes and clips of hm_codes against hm_code, one by one.
void expect_codes(const std::vector<double>& values, double scale, const NumberFormat& f,
                  const std::string& where) {
  const hm_format format = firmware_format(f);
  std::vector<std::uint32_t> words(values.size());
  const auto count = static_cast<std::uint32_t>(values.size());
  const std::uint32_t clipped = hm_codes(values.data(), count, scale, &format, words.data());
  std::uint32_t wanted_clipped = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    int beyond = 0;
    const std::int32_t wanted = hm_code(values[k] * scale, &format, &beyond);
    wanted_clipped += static_cast<std::uint32_t>(beyond);
    ASSERT_EQ(static_cast<std::int32_t>(words[k]), wanted)
        << f.text() << " " << std::hexfloat << values[k] << " * " << scale << " " << where;
  }
  ASSERT_EQ(clipped, wanted_clipped) << f.text() << " " << where;
}

/// Whole numbers, ties and what is just beside them, both ends of the format and beyond, tiny, huge,
/// infinite.
std::vector<double> corners(const NumberFormat& f) {
  std::vector<double> values{0.0, 5e-324, 2.2250738585072014e-308, 1e-300, 0x1p-60, 0x1.fffffffffffffp-2};
  const double high = static_cast<double>(f.max_raw());
  for (double whole : {0.0, 1.0, 2.0, 3.0, 6.0, 7.0, 0x1p20, high - 1, high, high + 1, high + 2, 2 * high})
    for (double half : {-0.5, 0.0, 0.5}) values.push_back(whole + half);
  for (int e = 30; e < 64; ++e)
    for (double beside : {-1.0, -0.5, 0.0, 0.5, 1.0}) values.push_back(std::ldexp(1.0, e) + beside);
  for (int e = 64; e < 1024; e += 37) values.push_back(std::ldexp(1.0, e));
  const std::size_t plain = values.size();
  for (std::size_t k = 0; k < plain; ++k)
    for (double toward : {-1e308, 1e308}) values.push_back(std::nextafter(values[k], toward));
  const std::size_t positive = values.size();
  for (std::size_t k = 0; k < positive; ++k) values.push_back(-values[k]);
  return values;
}

TEST(Codes, CornersInEveryModeAndWidth) {
  for (int width = 4; width <= 32; ++width)
    for_every_mode(width, 2, [](const NumberFormat& f) {
      const std::vector<double> values = corners(f);
      expect_codes(values, 1.0, f, "corners");
      expect_codes({values[3]}, 1.0, f, "one value");
      expect_codes({}, 1.0, f, "no value");
      for (double scale : {0x1p-900, 0x1p-3, 0x1p900}) expect_codes(values, scale, f, "scaled");
    });
}

TEST(Codes, ScaledBeyondDoublesSaturates) {
  for_every_mode(16, 2, [](const NumberFormat& f) {
    if (f.overflow != Overflow::wrap) expect_codes({1e308, -1e308, 1e300, 0.0}, 0x1p1000, f, "infinite");
  });
}

TEST(Codes, TenMillionRandomValuesInEveryMode) {
  const std::uint64_t seed = 77;
  Dice dice(seed);
  std::vector<double> values(10000);
  for (int round = 0; round < 1000; ++round) {
    NumberFormat f;
    f.width = static_cast<int>(dice.between(4, 32));
    f.integer_bits = static_cast<int>(dice.between(1, f.width - 1));
    f.rounding = static_cast<Rounding>(round % 7);
    f.overflow = static_cast<Overflow>(round / 7 % 4);
    const int spread = static_cast<int>(dice.between(-8, 3)) + f.width;
    for (double& x : values) {
      x = std::ldexp(dice.unit() * 2 - 1, spread - static_cast<int>(dice.below(8)));
      if (dice.one_in(3)) x = std::round(2 * x) / 2;
      if (dice.one_in(6)) x = std::nextafter(x, dice.one_in(2) ? 1e300 : -1e300);
    }
    const int shift = static_cast<int>(dice.between(-20, 20));
    for (double& x : values) x = std::ldexp(x, -shift);
    expect_codes(values, hm_power_of_two(shift), f,
                 "seed " + std::to_string(seed) + ", round " + std::to_string(round));
    if (HasFatalFailure()) return;
  }
}

} // namespace
} // namespace hopmesh::tests
