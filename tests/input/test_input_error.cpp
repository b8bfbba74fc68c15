// The sentence of a mistake, and which names are taken for typing mistakes of others.
#include "sim/input/input_error.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace input;

std::string sentence(const std::string& file, int line, const std::string& key, const std::string& found,
                     const std::string& expected, const std::string& nearest = "") {
  return input_error(file, line, key, found, expected, nearest).what();
}

TEST(InputError, saysPlaceKeyFoundExpectedAndNearest) {
  EXPECT_EQ(sentence("a.toml", 7, "mesh.pin", "\"lfet\"", "a side", "left"),
            "a.toml:7: mesh.pin: found \"lfet\", expected a side (did you mean left?)");
}

TEST(InputError, leavesOutWhatIsNotKnown) {
  EXPECT_EQ(sentence("a.toml", 0, "key", "x", "y"), "a.toml: key: found x, expected y");
  EXPECT_EQ(sentence("a.toml", 7, "", "x", "y"), "a.toml:7: found x, expected y");
  EXPECT_EQ(sentence("", 0, "key", "x", "y"), "key: found x, expected y");
  EXPECT_EQ(sentence("", 0, "", "x", ""), "found x");
  EXPECT_EQ(sentence("a.toml", 0, "", "", "y"), "a.toml: expected y");
}

TEST(InputError, isOneLineWhateverItIsMadeOf) {
  EXPECT_EQ(sentence("a\nb", 1, "k", "x\r\x1b[31m", "y"), "a\\x0Ab:1: k: found x\\x0D\\x1B[31m, expected y");
}

TEST(NearestName, findsTypingMistakes) {
  const std::vector<std::string> sides{"left", "right", "top", "bottom", "corners"};
  EXPECT_EQ(nearest_name("lft", sides), "left");     // one letter missing
  EXPECT_EQ(nearest_name("lleft", sides), "left");   // one too many
  EXPECT_EQ(nearest_name("lift", sides), "left");    // one wrong
  EXPECT_EQ(nearest_name("lfet", sides), "left");    // two swapped
  EXPECT_EQ(nearest_name("LEFT", sides), "left");    // another key held down
  EXPECT_EQ(nearest_name("buttm", sides), "bottom"); // two mistakes in a longer word
  EXPECT_EQ(nearest_name("corner", sides), "corners");
}

TEST(NearestName, takesTheCloserOfTwo) {
  EXPECT_EQ(nearest_name("flag-40", {"flag-400", "flag-400-literal", "flag-225"}), "flag-400");
  EXPECT_EQ(nearest_name("time_stp", {"time_stamp", "time_step"}), "time_step");
}

TEST(NearestName, isSilentWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("viscosity", {"gamma", "beta"}), "");
  EXPECT_EQ(nearest_name("w", {"x", "y", "z"}), ""); // every other letter would be as near
  EXPECT_EQ(nearest_name("", {"x"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), {std::string(100001, 'x')}), "");
}

TEST(InQuotes, showsBytesAsPrintableText) {
  EXPECT_EQ(in_quotes("left"), "\"left\"");
  EXPECT_EQ(in_quotes("a\x01\xff"), "\"a\\x01\\xFF\"");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), '"' + std::string(60, 'x') + "...\"");
}

TEST(InputError, ShortensAKeyThatNobodyWouldRead) {
  EXPECT_EQ(sentence("", 0, std::string(900'000, 'k'), "x", "y"),
            std::string(200, 'k') + "...: found x, expected y");
}

// A damaged file is quoted in many a message, by whoever found the damage.
TEST(InputError, IsOneLineOfUtf8WhateverItQuotes) {
  const std::string told = input_error("m\xC3\xBC.toml", 2, "key",
                                       "a\xFF"
                                       "b\x01",
                                       "c\n")
                               .what();
  EXPECT_EQ(told, "m\\xC3\\xBC.toml:2: key: found a\\xFFb\\x01, expected c\\x0A");
  EXPECT_STREQ(input_error("m\xC3\xBC.toml", 2, "key", "a", "b").what(),
               "m\xC3\xBC.toml:2: key: found a, expected b");
}

} // namespace
} // namespace hopmesh::tests
