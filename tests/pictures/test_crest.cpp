// The crest is a picture any program opens, and the same at every run.
#include "sim/pictures/crest/crest.h"
#include "sim/pictures/flag_crest.h"

#include <gtest/gtest.h>
#include <png.h>
#include <set>

namespace hopmesh::pictures {
namespace {

files::Picture decoded(std::string_view file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, file.data(), file.size()));
  image.format = PNG_FORMAT_RGBA;
  files::Picture picture{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr));
  return picture;
}

struct Pixel {
  int r, g, b, a;
};
Pixel at(const files::Picture& picture, std::uint32_t x, std::uint32_t y) {
  const auto* p = &picture.rgba[(std::size_t{y} * picture.width + x) * 4];
  return {p[0], p[1], p[2], p[3]};
}

TEST(Crest, PngDecodesToWhatWasDrawn) {
  const files::Picture picture = decoded(flag_crest());
  EXPECT_EQ(picture.width, 512u);
  EXPECT_EQ(picture.height, 512u);
  EXPECT_EQ(picture.rgba, draw_crest(512).rgba);
}

TEST(Crest, HasABlueFieldAndAGoldenShield) {
  const files::Picture picture = draw_crest(512);
  const Pixel field = at(picture, 80, 256), shield = at(picture, 160, 280);
  EXPECT_GT(field.b, 2 * field.r);
  EXPECT_GT(shield.r, 150);
  EXPECT_GT(shield.r, 2 * shield.b);
  EXPECT_EQ(field.a, 255);
  const std::set<std::uint8_t> greens(picture.rgba.begin(), picture.rgba.end());
  EXPECT_GT(greens.size(), 100u) << "a blank picture has few values";
}

TEST(Crest, TheOneInTheProgramIsWhatIsDrawn) {
  EXPECT_EQ(crest_png(512), flag_crest());
}

TEST(Crest, SmallSizesWork) {
  EXPECT_EQ(decoded(crest_png(1)).width, 1u);
  EXPECT_EQ(decoded(crest_png(33)).height, 33u);
}

} // namespace
} // namespace hopmesh::pictures
