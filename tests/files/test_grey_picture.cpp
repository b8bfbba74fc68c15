// Pictures come in as they were made: PGM written by hand, PNG by our own encoder.
#include "sim/files/grey_picture.h"
#include "sim/files/png.h"
#include "tests/support/complaint.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace files;

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(GreyPicture, ReadsPlainPgmWithComments) {
  const GreyPicture p = read_grey("P2 # what it is\n3 2\n# white:\n4\n0 1 2\n3 4 0\n");
  EXPECT_EQ(p.width, 3u);
  EXPECT_EQ(p.height, 2u);
  EXPECT_THAT(p.shade, ElementsAre(0, 0.25, 0.5, 0.75, 1, 0));
  EXPECT_EQ(p.at(1, 1), 1);
}

TEST(GreyPicture, ReadsRawPgmOfOneAndTwoBytes) {
  EXPECT_THAT(read_grey(std::string_view("P5\n2 1\n255\n\x00\xff", 13)).shade, ElementsAre(0, 1));
  // 16 bits, the high byte first; the first pixel's high byte is the number of a line feed
  const GreyPicture wide = read_grey(std::string_view("P5\n2 1\n65535\n\x0a\x00\xff\xff", 17));
  EXPECT_THAT(wide.shade, ElementsAre(2560 / 65535.0, 1));
}

TEST(GreyPicture, ReadsPngAndKeepsItsGreys) {
  const Picture made{2, 2, {0, 0, 0, 255, 51, 51, 51, 255, 255, 255, 255, 255, 255, 255, 255, 0}};
  const GreyPicture p = read_grey(encode_png(made));
  EXPECT_EQ(p.width, 2u);
  EXPECT_THAT(p.shade, ElementsAre(0, 0.2, 1, 0)) << "what is transparent lies on black";
}

std::string refusal(std::string_view bytes) {
  return complaint<NoPicture>([&] { read_grey(bytes); });
}

TEST(GreyPicture, SaysWhatIsNone) {
  EXPECT_THAT(refusal(""), HasSubstr("no picture"));
  EXPECT_THAT(refusal("P6 1 1 255 abc"), HasSubstr("no picture"));
  EXPECT_THAT(refusal("P2 x"), HasSubstr("without a width"));
  EXPECT_THAT(refusal("P2 1"), HasSubstr("without a height"));
  EXPECT_THAT(refusal("P2 1 0 3"), HasSubstr("1 x 0 pixels"));
  EXPECT_THAT(refusal("P2 99999 1 3"), HasSubstr("99999 x 1 pixels"));
  EXPECT_THAT(refusal("P2 1 1 0 0"), HasSubstr("white is 0"));
  EXPECT_THAT(refusal("P2 2 1 3 1"), HasSubstr("without all its pixels"));
  EXPECT_THAT(refusal("P2 1 1 3 4"), HasSubstr("brighter than its white"));
  EXPECT_THAT(refusal("P5 2 2 255 ab"), HasSubstr("ends early"));
  EXPECT_THAT(refusal("\x89PNG\r\n\x1a\nrest"), HasSubstr("libpng refuses"));
}

} // namespace
} // namespace hopmesh::tests
