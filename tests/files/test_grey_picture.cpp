// Pictures come in as they were made: PGM written by hand, PNG by our own encoder and by libpng.
#include "sim/files/grey_picture.h"
#include "sim/files/png.h"
#include "tests/support/complaint.h"

#include <gmock/gmock.h>
#include <png.h>

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

TEST(GreyPicture, TheLineEndOfTwoBytesBehindAPgmHeaderIsNoPixel) {
  EXPECT_THAT(read_grey(std::string_view("P5\r\n2 1\r\n255\r\n\x00\xff", 16)).shade, ElementsAre(0, 1));
  EXPECT_THAT(read_grey(std::string_view("P5\n2 1\n255\n\x00\xff\n", 14)).shade, ElementsAre(0, 1))
      << "a last line end";
  EXPECT_THAT(read_grey(std::string_view("P5\n2 1\n255\r\n\xff", 13)).shade, ElementsAre(10 / 255.0, 1));
}

/// What a PNG may be.
struct PngForm {
  int colours = PNG_COLOR_TYPE_GRAY, bits = 8, interlace = PNG_INTERLACE_NONE;
  double gamma = 0;     ///< 0: not told
  int transparent = -1; ///< the grey that is
};

/// A PNG of rows of samples as they lie in the file, by libpng.
std::string png_of(std::uint32_t width, std::vector<std::string> rows, const PngForm& form) {
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp to, png_bytep data, png_size_t bytes) {
    static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<char*>(data), bytes);
  };
  png_set_write_fn(png, &file, append, nullptr);
  png_set_IHDR(png, info, width, static_cast<std::uint32_t>(rows.size()), form.bits, form.colours,
               form.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (form.gamma > 0) png_set_gAMA(png, info, form.gamma);
  png_color_16 grey{};
  grey.gray = static_cast<png_uint_16>(form.transparent);
  if (form.transparent >= 0) png_set_tRNS(png, info, nullptr, 0, &grey);
  std::vector<png_bytep> row;
  for (std::string& samples : rows) row.push_back(reinterpret_cast<png_bytep>(samples.data()));
  png_set_rows(png, info, row.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return file;
}

std::string two_bytes(std::uint32_t sample) {
  return {static_cast<char>(sample >> 8), static_cast<char>(sample)};
}

/// A shade of its own in every pixel of a picture that is wider than an Adam7 tile.
std::uint32_t shade_at(std::uint32_t row, std::uint32_t column) {
  return (row * 11 + column) * 523;
}

TEST(GreyPicture, SixteenBitsAreKeptInterlacedOrNot) {
  constexpr std::uint32_t width = 11, height = 9;
  std::vector<std::string> rows(height);
  for (std::uint32_t r = 0; r < height; ++r)
    for (std::uint32_t c = 0; c < width; ++c) rows[r] += two_bytes(shade_at(r, c));
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    const GreyPicture p = read_grey(png_of(width, rows, {PNG_COLOR_TYPE_GRAY, 16, interlace}));
    ASSERT_EQ(p.shade.size(), width * height);
    for (std::uint32_t r = 0; r < height; ++r)
      for (std::uint32_t c = 0; c < width; ++c)
        EXPECT_EQ(p.at(r, c), shade_at(r, c) / 65535.0) << r << ' ' << c;
  }
}

TEST(GreyPicture, SamplesCountAsWrittenWhateverGammaIsTold) {
  const std::vector<std::string> eight{std::string("\x00\x33\x66\xcc", 4)};
  const std::vector<std::string> sixteen{std::string("\x00\x00\x33\x33\x66\x66\xcc\xcc", 8)};
  for (const double gamma : {0.0, 1.0, 0.45455}) {
    const PngForm form{PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_NONE, gamma},
        wide{PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_NONE, gamma};
    EXPECT_THAT(read_grey(png_of(4, eight, form)).shade, ElementsAre(0, 0.2, 0.4, 0.8));
    EXPECT_THAT(read_grey(png_of(4, sixteen, wide)).shade, ElementsAre(0, 0.2, 0.4, 0.8));
  }
}

TEST(GreyPicture, FewBitsAndColours) {
  EXPECT_THAT(read_grey(png_of(4, {"\x1b"}, {PNG_COLOR_TYPE_GRAY, 2})).shade,
              ElementsAre(0, 85 / 255.0, 170 / 255.0, 1));
  EXPECT_THAT(read_grey(png_of(2, {std::string("\xff\x00\x00\x00\xff\x00", 6)}, {PNG_COLOR_TYPE_RGB})).shade,
              ElementsAre(testing::DoubleEq(0.299), testing::DoubleEq(0.587)));
}

TEST(GreyPicture, TransparentPixelsLieOnTheGroundAndAreCounted) {
  const std::string half =
      png_of(3, {std::string("\x00\x00\xff\x33\x00\xff", 6)}, {PNG_COLOR_TYPE_GRAY_ALPHA});
  EXPECT_THAT(read_grey(half).shade, ElementsAre(0, 0.2, 0));
  EXPECT_THAT(read_grey(half, 1).shade, ElementsAre(1, 1, 0));
  EXPECT_EQ(read_grey(half).transparent, 2u);
  const PngForm of_one_grey{PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_ADAM7, 0, 0x3333};
  const GreyPicture p = read_grey(png_of(2, {std::string("\x33\x33\x33\x34", 4)}, of_one_grey), 1);
  EXPECT_THAT(p.shade, ElementsAre(1, 0x3334 / 65535.0));
  EXPECT_EQ(p.transparent, 1u);
}

TEST(GreyPicture, ADamagedPngIsRefusedWhereverItIsCut) {
  const std::string good =
      png_of(4, {std::string("\x00\x33\x66\xcc", 4)}, {PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_ADAM7, 0, 0x33});
  for (std::size_t cut = 8; cut < good.size(); ++cut)
    EXPECT_THROW(read_grey(good.substr(0, cut)), NoPicture) << cut;
  std::size_t read = 0;
  for (std::size_t at = 8; at < good.size(); ++at) {
    std::string spoilt = good;
    spoilt[at] = static_cast<char>(spoilt[at] ^ 0x10);
    try {
      read_grey(spoilt);
      ++read;
    } catch (const NoPicture&) {
    }
  }
  EXPECT_EQ(read, 0u) << "every chunk has a sum of its own";
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
  EXPECT_THAT(refusal("P5 2 1 255 abc"), HasSubstr("1 bytes behind its pixels"));
  EXPECT_THAT(refusal("\x89PNG\r\n\x1a\nrest"), HasSubstr("libpng refuses"));
}

} // namespace
} // namespace hopmesh::tests
