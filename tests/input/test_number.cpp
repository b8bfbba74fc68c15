// Numbers are whole texts, lines end as either system ends them, and words are what stands between blanks.
#include "sim/input/line_reader.h"
#include "sim/input/number.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hopmesh::tests {
namespace {

using namespace input;

TEST(Number, IsTheWholeText) {
  std::uint64_t count = 7;
  EXPECT_TRUE(parse_number("18446744073709551615", count));
  EXPECT_EQ(count, UINT64_MAX);
  for (const char* bad : {"", " 1", "1 ", "1x", "-1", "+1", "18446744073709551616", "1.0"})
    EXPECT_FALSE(parse_number(bad, count)) << bad;
  EXPECT_EQ(count, UINT64_MAX) << "as it was";
  EXPECT_TRUE(parse_number("ff", count, 16));
  EXPECT_EQ(count, 255u);
  std::int64_t integer = 0;
  EXPECT_TRUE(parse_number("-12", integer));
  EXPECT_EQ(integer, -12);
}

TEST(Number, RealOnesMayHaveAPlus) {
  double real = 0;
  for (const char* good : {"0.25", "+0.25", "25e-2", ".25"}) {
    EXPECT_TRUE(parse_number(good, real)) << good;
    EXPECT_EQ(real, 0.25);
    real = 0;
  }
  for (const char* bad : {"", "+", "+-1", "++1", "0x1p3", "1,5", "1e", "1e999"})
    EXPECT_FALSE(parse_number(bad, real)) << bad;
}

TEST(Number, TooSmallIsZeroTooLargeIsNone) {
  double real = 1;
  for (const char* tiny : {"1e-400", "-0.000e-999", "0.0001e-330", "12345e-400", "1E-99999999999999999999"}) {
    real = 1;
    EXPECT_TRUE(parse_number(tiny, real)) << tiny;
    EXPECT_EQ(real, 0) << tiny;
  }
  EXPECT_TRUE(parse_number("4.9e-324", real));
  EXPECT_GT(real, 0);
  const std::string long_tiny = "0." + std::string(400, '0') + "1", long_large = std::string(400, '9');
  EXPECT_TRUE(parse_number(long_tiny, real));
  EXPECT_EQ(real, 0);
  for (const std::string huge : {"1e400", "-1e999", "0.001e500", "1e99999999999999999999"})
    EXPECT_FALSE(parse_number(huge, real)) << huge;
  EXPECT_FALSE(parse_number(long_large, real));
}

TEST(Number, RealOnesMayBeOfFortran) {
  double real = 0;
  for (const char* good : {"2.5D-1", "+25d-2", "0.25", "2.5E-01"}) {
    EXPECT_TRUE(parse_real(good, real)) << good;
    EXPECT_EQ(real, 0.25);
    real = 0;
  }
  for (const char* bad : {"", "D", "d1", "1D", "1D2D3", "1D2E3", "1.#IND"})
    EXPECT_FALSE(parse_real(bad, real)) << bad;
}

TEST(LineReader, GivesEachLineAndItsNumber) {
  LineReader lines("one\r\n\n three\t3 \nlast");
  std::vector<std::string> found;
  while (lines.next()) found.push_back(std::to_string(lines.number()) + std::string(lines.line()));
  EXPECT_EQ(found, (std::vector<std::string>{"1one", "2", "3 three\t3 ", "4last"}));
  EXPECT_FALSE(LineReader("").next());
}

std::vector<std::string> lines_of_text(std::string_view text) {
  LineReader lines(text);
  std::vector<std::string> found;
  while (lines.next()) found.emplace_back(lines.line());
  return found;
}

TEST(LineReader, KnowsTheLineEndsOfAnySystem) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines_of_text("a\rb\r\rc"), (Lines{"a", "b", "", "c"}));
  EXPECT_EQ(lines_of_text("a\rb\r\nc\nd\r"), (Lines{"a", "b", "c", "d"}));
  EXPECT_EQ(lines_of_text("\r\n"), (Lines{""}));
}

TEST(LineReader, LeavesOutAByteOrderMark) {
  EXPECT_EQ(lines_of_text("\xEF\xBB\xBF"
                          "a\n\xEF\xBB\xBF"
                          "b"),
            (std::vector<std::string>{"a", "\xEF\xBB\xBF"
                                           "b"}));
  EXPECT_EQ(lines_of_text("\xEF\xBB\xBF"), std::vector<std::string>{});
}

TEST(Words, AreEmptyAtTheEnd) {
  Words words("  f\t\f1/2 3  4 \r");
  EXPECT_EQ(words.next(), "f");
  EXPECT_EQ(words.next(), "1/2");
  EXPECT_EQ(words.rest(), "3  4 \r");
  EXPECT_EQ(words.next(), "3");
  EXPECT_EQ(words.next(), "4");
  EXPECT_EQ(words.next(), "");
  EXPECT_EQ(words.next(), "");
}

} // namespace
} // namespace hopmesh::tests
