#include "sim/files/grey_picture.h"

#include "sim/input/number.h"

#include <algorithm>
#include <png.h>
#include <string>

namespace hopmesh::files {
namespace {

constexpr std::uint32_t most_side = 16384;

/// The numbers of a PGM header or of its plain form, one at a time; a comment ends with its line.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : rest_(bytes) {}

  std::uint32_t next(const char* name) {
    skip();
    const std::string_view digits = rest_.substr(0, rest_.find_first_of(" \t\r\n#"));
    std::uint64_t value = 0;
    if (!input::parse_number(digits, value) || value > UINT32_MAX)
      throw NoPicture("a PGM picture without " + std::string(name));
    rest_.remove_prefix(digits.size());
    return static_cast<std::uint32_t>(value);
  }

  /// The pixels of a picture in bytes: one blank parts them from the header.
  std::string_view bytes() const { return rest_.substr(rest_.empty() ? 0 : 1); }

 private:
  void skip() {
    for (;;) {
      const auto first = rest_.find_first_not_of(" \t\r\n");
      rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
      if (rest_.empty() || rest_.front() != '#') return;
      rest_.remove_prefix(std::min(rest_.size(), rest_.find('\n')));
    }
  }

  std::string_view rest_;
};

void check_size(std::uint32_t width, std::uint32_t height) {
  if (width < 1 || height < 1 || width > most_side || height > most_side)
    throw NoPicture("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
}

GreyPicture read_pgm(std::string_view bytes) {
  const bool plain = bytes[1] == '2';
  Numbers numbers(bytes.substr(2));
  GreyPicture picture;
  picture.width = numbers.next("a width");
  picture.height = numbers.next("a height");
  const std::uint32_t white = numbers.next("a white");
  check_size(picture.width, picture.height);
  if (white < 1 || white > 65535) throw NoPicture("a PGM picture whose white is " + std::to_string(white));
  const std::size_t count = std::size_t{picture.width} * picture.height, wide = white > 255 ? 2 : 1;
  const std::string_view raw = plain ? "" : numbers.bytes();
  if (!plain && raw.size() < count * wide) throw NoPicture("a PGM picture that ends early");
  for (std::size_t k = 0; k < count; ++k) {
    const auto byte = [&](std::size_t at) { return std::uint32_t{static_cast<unsigned char>(raw[at])}; };
    const std::uint32_t shade = plain       ? numbers.next("all its pixels")
                                : wide == 1 ? byte(k)
                                            : byte(2 * k) << 8 | byte(2 * k + 1);
    if (shade > white) throw NoPicture("a PGM pixel brighter than its white");
    picture.shade.push_back(static_cast<double>(shade) / white);
  }
  return picture;
}

GreyPicture read_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    throw NoPicture(std::string("a PNG picture that libpng refuses: ") + image.message);
  GreyPicture picture{image.width, image.height, {}};
  std::vector<std::uint8_t> raw;
  if (image.width <= most_side && image.height <= most_side) {
    image.format = PNG_FORMAT_GRAY;
    raw.resize(PNG_IMAGE_SIZE(image));
    const png_color black{0, 0, 0}; // behind whatever is transparent
    if (!png_image_finish_read(&image, &black, raw.data(), 0, nullptr))
      throw NoPicture(std::string("a PNG picture that libpng refuses: ") + image.message);
  } else {
    png_image_free(&image);
  }
  check_size(picture.width, picture.height);
  for (const std::uint8_t shade : raw) picture.shade.push_back(shade / 255.0);
  return picture;
}

} // namespace

GreyPicture read_grey(std::string_view bytes) {
  if (bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5')) return read_pgm(bytes);
  if (bytes.substr(0, 4) == "\x89PNG") return read_png(bytes);
  throw NoPicture("no picture");
}

} // namespace hopmesh::files
