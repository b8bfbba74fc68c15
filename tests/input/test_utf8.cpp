// What UTF-8 is, against the table of the Unicode standard (3-7): its borders, and what is just outside.
#include "sim/input/utf8.h"
#include "tests/support/complaint.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using input::is_utf8;

TEST(Utf8, TakesEveryWellFormedRange) {
  for (const char* text : {"", "abc", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                           "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "Δt = α"})
    EXPECT_TRUE(is_utf8(text)) << text;
}

TEST(Utf8, RefusesWhatIsNone) {
  for (const char* text : {"\x80", "\xbf", "\xff", "\xfe", "b\xff", "\xc0\x80", "\xc1\xbf", "\xc2",
                           "\xc2"
                           "a",
                           "\xe0\x9f\xbf", "\xed\xa0\x80", "\xed\xbf\xbf", "\xe2\x82", "\xf0\x8f\xbf\xbf",
                           "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

TEST(Utf8, IsAskedForInASentence) {
  EXPECT_EQ(complaint([] { input::expect_utf8("scene", "b\xff"); }),
            "scene: found \"b\\xFF\", expected UTF-8");
}

} // namespace
} // namespace hopmesh::tests
