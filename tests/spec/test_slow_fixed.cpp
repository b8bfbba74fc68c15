// The oracle itself: against tables worked out by hand, and against SystemC's own fixed-point types.
#define SC_INCLUDE_FX
#include "tests/support/random_network.h"
#include "tests/support/slow_neuron.h"

#include <gtest/gtest.h>
#include <systemc>

#include <cmath>

namespace hopmesh::tests {
namespace {

using spec::NumberFormat;
using spec::Overflow;
using spec::Rounding;

constexpr int modes = 7, overflows = 4;

/// What SystemC makes of code * 2^-fraction in a format.
std::int64_t systemc_code(const sc_dt::sc_fxval& value, const NumberFormat& f) {
  sc_dt::sc_fix rounded(f.width, f.integer_bits, static_cast<sc_dt::sc_q_mode>(f.rounding),
                        static_cast<sc_dt::sc_o_mode>(f.overflow));
  rounded = value;
  sc_dt::sc_fxval code = rounded;
  code <<= f.fraction_bits();
  // In two parts: to_int64() of SystemC 2.3.4 loses everything above 31 bits.
  const double high = code.to_double();
  return static_cast<std::int64_t>(high) +
         static_cast<std::int64_t>(sc_dt::sc_fxval(code - sc_dt::sc_fxval(high)).to_double());
}

sc_dt::sc_fxval exactly(std::int64_t code, int fraction) {
  sc_dt::sc_fxval value(static_cast<sc_dt::int64>(code));
  if (fraction >= 0)
    value >>= fraction;
  else
    value <<= -fraction;
  return value;
}

TEST(SlowFixed, RoundsHalvesAsTheTableSays) {
  // Quarters of a last place, -10/4 ... 10/4, worked out by hand.
  const std::int64_t quarters[] = {-10, -7, -6, -5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 10};
  const std::int64_t expected[modes][17] = {
      {-2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3},   // SC_RND
      {-2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2},   // SC_RND_ZERO
      {-3, -2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2},  // SC_RND_MIN_INF
      {-3, -2, -2, -1, -1, -1, -1, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3},  // SC_RND_INF
      {-2, -2, -2, -1, -1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2},   // SC_RND_CONV
      {-3, -2, -2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2}, // SC_TRN
      {-2, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2}};   // SC_TRN_ZERO
  for (int q = 0; q < modes; ++q)
    for (int k = 0; k < 17; ++k) {
      const NumberFormat f{8, 8, static_cast<Rounding>(q), Overflow::sat};
      const bool negative = quarters[k] < 0;
      EXPECT_EQ(quantise_code(quarters[k], 2, f), expected[q][k]) << f.text() << " " << quarters[k] << "/4";
      EXPECT_EQ(quantise_double(quarters[k] * 0.25, 0, f), expected[q][k])
          << f.text() << " " << quarters[k] << "/4";
      EXPECT_EQ(quantise(cut_quotient(magnitude_of(quarters[k] * 7), 28), negative, f), expected[q][k])
          << f.text();
    }
}

TEST(SlowFixed, BringsIntoRangeAsTheTableSays) {
  const std::int64_t values[] = {-25, -17, -16, -9, -8, 7, 8, 15, 16, 25}; // into 4 bits: -8 ... 7
  const std::int64_t expected[overflows][10] = {{-8, -8, -8, -8, -8, 7, 7, 7, 7, 7},
                                                {0, 0, 0, 0, -8, 7, 0, 0, 0, 0},
                                                {-7, -7, -7, -7, -7, 7, 7, 7, 7, 7},
                                                {7, -1, 0, 7, -8, 7, -8, -1, 0, -7}};
  for (int o = 0; o < overflows; ++o)
    for (int k = 0; k < 10; ++k) {
      const NumberFormat f{4, 4, Rounding::trn, static_cast<Overflow>(o)};
      EXPECT_EQ(quantise_code(values[k], 0, f), expected[o][k]) << f.text() << " " << values[k];
    }
}

TEST(SlowFixed, HugeAndTinyDoubles) {
  const NumberFormat sat{16, 2, Rounding::rnd, Overflow::sat}, wrap{16, 2, Rounding::trn, Overflow::wrap};
  EXPECT_EQ(quantise_double(1e300, 0, sat), 32767);
  EXPECT_EQ(quantise_double(-1e300, 900, sat), -32768);
  EXPECT_EQ(quantise_double(1e300, 0, wrap), 0);
  EXPECT_EQ(quantise_double(5e-324, 0, sat), 0);
  EXPECT_EQ(quantise_double(-5e-324, 0, wrap), -1);
  EXPECT_EQ(quantise_double(5e-324, 1074, sat), 16384);
  EXPECT_EQ(quantise_double(0x1p-15, 0, sat), 1);  // half a last place, up
  EXPECT_EQ(quantise_double(-0x1p-15, 0, sat), 0); // half a last place, up
  EXPECT_EQ(quantise_double(2.0 + 0x1p-14, 0, wrap), -32767);
}

TEST(SlowFixed, AgreesWithSystemCOnEveryByteInEveryMode) {
  for (int q = 0; q < modes; ++q)
    for (int o = 0; o < overflows; ++o)
      for (std::int64_t code = -1024; code <= 1024; ++code)
        for (int fraction : {0, 3, 6, 8}) {
          const NumberFormat f{6, 3, static_cast<Rounding>(q), static_cast<Overflow>(o)};
          ASSERT_EQ(quantise_code(code, fraction, f), systemc_code(exactly(code, fraction), f))
              << f.text() << " " << code << " / 2^" << fraction;
        }
}

TEST(SlowFixed, AgreesWithSystemCOnRandomFormatsAndValues) {
  const std::uint64_t seed = 20240607;
  Dice dice(seed);
  for (int k = 0; k < 300000; ++k) {
    NumberFormat f;
    f.width = static_cast<int>(dice.between(4, dice.one_in(2) ? 12 : 62));
    f.integer_bits = static_cast<int>(dice.between(1, f.width));
    f.rounding = static_cast<Rounding>(dice.below(modes));
    f.overflow = static_cast<Overflow>(dice.below(overflows));
    const int fraction = static_cast<int>(dice.between(f.fraction_bits() - 4, f.fraction_bits() + 24));
    const int bits = static_cast<int>(dice.between(2, 63));
    const std::int64_t code = dice.code({bits, 1, Rounding::trn, Overflow::wrap});
    ASSERT_EQ(quantise_code(code, fraction, f), systemc_code(exactly(code, fraction), f))
        << "seed " << seed << ", case " << k << ": " << f.text() << " " << code << " / 2^" << fraction;
  }
}

TEST(SlowFixed, DoublesAgreeWithSystemC) {
  const std::uint64_t seed = 4711;
  Dice dice(seed);
  for (int k = 0; k < 100000; ++k) {
    NumberFormat f{static_cast<int>(dice.between(4, 32)), 2, static_cast<Rounding>(dice.below(modes)),
                   static_cast<Overflow>(dice.below(overflows))};
    const int scale = static_cast<int>(dice.between(-40, 8));
    double value = std::ldexp(dice.unit() * 2 - 1, scale);
    if (dice.one_in(3))
      value = std::ldexp(std::round(std::ldexp(value, f.fraction_bits() + 1)), -f.fraction_bits() - 1);
    ASSERT_EQ(quantise_double(value, 0, f), systemc_code(sc_dt::sc_fxval(value), f))
        << "seed " << seed << ", case " << k << ": " << f.text() << " " << value;
  }
}

/// The static type, for the combinations that a template can name.
template <int q, int o> void compare_static_type() {
  using Fixed = sc_dt::sc_fixed<8, 3, static_cast<sc_dt::sc_q_mode>(q), static_cast<sc_dt::sc_o_mode>(o)>;
  const NumberFormat f{8, 3, static_cast<Rounding>(q), static_cast<Overflow>(o)};
  for (std::int64_t code = -4096; code <= 4096; ++code) {
    const Fixed rounded = exactly(code, 8);
    ASSERT_EQ(quantise_code(code, 8, f), std::llround(rounded.to_double() * 32))
        << f.text() << " " << code << " / 2^8";
  }
}

template <int... k> void compare_static_types(std::integer_sequence<int, k...>) {
  (compare_static_type<k / overflows, k % overflows>(), ...);
}

TEST(SlowFixed, AgreesWithTheStaticTypeInEveryMode) {
  compare_static_types(std::make_integer_sequence<int, modes * overflows>());
}

TEST(SlowNeuron, OutputStageAgreesWithSystemCsTypes) {
  const std::uint64_t seed = 99;
  Dice dice(seed);
  for (int k = 0; k < 100000; ++k) {
    spec::Formats f;
    f.drive = {static_cast<int>(dice.between(4, 32)), 2, static_cast<Rounding>(dice.below(modes)),
               Overflow::sat};
    f.state = {static_cast<int>(dice.between(4, 32)), 2, static_cast<Rounding>(dice.below(modes)),
               Overflow::sat};
    const std::int64_t one = f.state.one_raw(),
                       v = dice.one_in(8) ? dice.between(-1, 1) * one : dice.between(-one, one);
    const std::int64_t u_one = f.drive.one_raw(),
                       u = dice.one_in(8) ? dice.between(-1, 1) * u_one : dice.between(-u_one, u_one);
    const sc_dt::sc_fxval state = exactly(v, f.state.fraction_bits()),
                          drive_value = exactly(u, f.drive.fraction_bits());
    const sc_dt::sc_fxval r = u >= 0 ? sc_dt::sc_fxval(1 - state) : sc_dt::sc_fxval(1 + state);
    const NumberFormat wider{f.state.width + 1, f.state.integer_bits + 1, f.state.rounding, Overflow::sat};
    const std::int64_t moved = systemc_code(sc_dt::sc_fxval(r * drive_value), wider);
    ASSERT_EQ(change(f, v, u), moved) << "seed " << seed << ", case " << k << ": V " << v << ", u " << u
                                      << " " << f.drive.text() << " " << f.state.text();
    ASSERT_LE(std::abs(v + moved), one);
  }
}

TEST(SlowNeuron, FromOneBoundToTheOtherInOneStep) {
  // R u = 2 has no code in fixed<8,2>; V + R u has. The proof of |V| <= 1 leans on it.
  for (int o = 0; o < overflows; ++o) {
    spec::Formats f;
    f.drive = f.state = {8, 2, Rounding::trn_zero, static_cast<Overflow>(o)};
    EXPECT_EQ(change(f, -64, 64), 128) << f.state.text();
    EXPECT_EQ(change(f, 64, -64), -128) << f.state.text();
  }
}

TEST(SlowNeuron, MultipliesLikeTheProcessor) {
  Dice dice(5);
  for (int k = 0; k < 100000; ++k) {
    const std::int64_t a = dice.code({32, 1}), b = dice.code({32, 2});
    ASSERT_EQ(multiply(a, b), static_cast<__int128>(a) * b) << a << " " << b;
  }
}

} // namespace
} // namespace hopmesh::tests
