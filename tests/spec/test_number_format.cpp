// Formats as text and as ranges; the numbers are worked out by hand.
#include "rtl_model/spec/number_format.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace spec;

TEST(NumberFormat, LeavesSystemCsDefaultsWhereTheTextSaysNothing) {
  const auto two = parse_format("fixed<8,2>");
  ASSERT_TRUE(two);
  EXPECT_EQ(*two, (NumberFormat{8, 2, Rounding::trn, Overflow::wrap}));
  const auto three = parse_format("fixed<16,4,SC_RND>");
  ASSERT_TRUE(three);
  EXPECT_EQ(*three, (NumberFormat{16, 4, Rounding::rnd, Overflow::wrap}));
}

TEST(NumberFormat, ReadsWhatItPrintsForEveryMode) {
  for (std::string_view q : rounding_names)
    for (std::string_view o : overflow_names) {
      const std::string text = "fixed<24,9," + std::string(q) + "," + std::string(o) + ">";
      const auto format = parse_format(text);
      ASSERT_TRUE(format) << text;
      EXPECT_EQ(format->text(), text);
      EXPECT_EQ(name_of(format->rounding), q);
      EXPECT_EQ(name_of(format->overflow), o);
    }
}

TEST(NumberFormat, NumbersModesAsSystemCDoes) {
  EXPECT_EQ(static_cast<int>(Rounding::rnd), 0);
  EXPECT_EQ(static_cast<int>(Rounding::rnd_conv), 4);
  EXPECT_EQ(static_cast<int>(Rounding::trn_zero), 6);
  EXPECT_EQ(static_cast<int>(Overflow::sat), 0);
  EXPECT_EQ(static_cast<int>(Overflow::wrap), 3);
}

TEST(NumberFormat, ForgivesSpacesAndReadsSigns) {
  const auto spaced = parse_format("  fixed < 10 , -3 , SC_TRN_ZERO , SC_SAT_SYM > ");
  ASSERT_TRUE(spaced);
  EXPECT_EQ(*spaced, (NumberFormat{10, -3, Rounding::trn_zero, Overflow::sat_sym}));
  EXPECT_EQ(spaced->fraction_bits(), 13);
}

TEST(NumberFormat, RefusesWhatIsNoFormat) {
  for (const char* text :
       {"", "fixed", "fixed<>", "fixed<8>", "fixed<8,2", "fixed<8;2>", "fixed<8,2,>", "fixed<8,2,RND>",
        "fixed<8,2,SC_SAT>", "fixed<8,2,SC_RND,SC_RND>", "fixed<8,2,SC_RND,SC_SAT,1>", "ufixed<8,2>",
        "fixed<8.5,2>", "fixed<-8,2>", "fixed<1000,2>", "fixed<8,2> x", "fixed<8,2,sc_rnd>"})
    EXPECT_FALSE(parse_format(text)) << text;
}

TEST(NumberFormat, RangesAreThoseOfTwosComplement) {
  const NumberFormat byte{8, 2, Rounding::rnd, Overflow::sat};
  EXPECT_EQ(byte.fraction_bits(), 6);
  EXPECT_EQ(byte.max_raw(), 127);
  EXPECT_EQ(byte.min_raw(), -128);
  EXPECT_EQ(byte.one_raw(), 64);
  const NumberFormat symmetric{8, 2, Rounding::rnd, Overflow::sat_sym};
  EXPECT_EQ(symmetric.min_raw(), -127);
  const NumberFormat widest{62, 31, Rounding::rnd, Overflow::wrap};
  EXPECT_EQ(widest.max_raw(), 2305843009213693951);
  EXPECT_EQ(widest.min_raw(), -2305843009213693952);
}

} // namespace
} // namespace hopmesh::tests
