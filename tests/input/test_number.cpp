// Numbers are whole texts, lines end as either system ends them, and words are what stands between blanks.
#include "sim/input/line_reader.h"
#include "sim/input/number.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hopmesh::input {
namespace {

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

TEST(LineReader, GivesEachLineAndItsNumber) {
  LineReader lines("one\r\n\n three\t3 \nlast");
  std::vector<std::string> found;
  while (lines.next()) found.push_back(std::to_string(lines.number()) + std::string(lines.line()));
  EXPECT_EQ(found, (std::vector<std::string>{"1one", "2", "3 three\t3 ", "4last"}));
  EXPECT_FALSE(LineReader("").next());
}

TEST(Words, AreEmptyAtTheEnd) {
  Words words("  f\t1/2 3  4 \r");
  EXPECT_EQ(words.next(), "f");
  EXPECT_EQ(words.next(), "1/2");
  EXPECT_EQ(words.rest(), "3  4 \r");
  EXPECT_EQ(words.next(), "3");
  EXPECT_EQ(words.next(), "4");
  EXPECT_EQ(words.next(), "");
  EXPECT_EQ(words.next(), "");
}

} // namespace
} // namespace hopmesh::input
