// PNG by libpng's full interface: samples come out as they were written, 16 bits and all, whatever the file
// says of gamma, and interlaced rows in their places.
#include "sim/files/grey_formats.h"

#include <cstring>
#include <png.h>
#include <string>

namespace hopmesh::files {
namespace {

class PngReader {
 public:
  explicit PngReader(std::string_view bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, refuse, [](png_structp, png_const_charp) {});
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) throw std::runtime_error("libpng cannot start");
    png_set_read_fn(png_, this, give);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT); // a lost tRNS would change shades
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  void read() {
    guarded([this] { png_read_info(png_, info_); });
    check_size(width(), height());
    guarded([this] { expand(); });
    rows_.resize(row_bytes() * height());
    std::vector<png_bytep> row;
    for (std::size_t y = 0; y < height(); ++y) row.push_back(rows_.data() + y * row_bytes());
    png_bytepp const first = row.data();
    guarded([this, first] { png_read_image(png_, first), png_read_end(png_, nullptr); });
  }

  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  std::size_t channels() const { return png_get_channels(png_, info_); }
  /// The largest a sample can be.
  std::uint32_t white() const { return is_wide() ? 65535 : 255; }

  std::uint32_t sample(std::size_t pixel, std::size_t channel) const {
    const std::size_t at = pixel * channels() + channel; // rows have no gaps: samples are whole bytes
    const auto byte = [&](std::size_t k) { return std::uint32_t{rows_[k]}; };
    return is_wide() ? byte(2 * at) << 8 | byte(2 * at + 1) : byte(at);
  }

 private:
  /// libpng leaves a mistake by a long jump, and passes no C++ object on its way.
  template <typename Step> void guarded(Step step) {
    if (setjmp(png_jmpbuf(png_))) throw NoPicture(std::string("a PNG picture that libpng refuses: ") + why_);
    step();
  }

  [[noreturn]] static void refuse(png_structp png, png_const_charp why) {
    auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader->why_, why, sizeof reader->why_ - 1);
    png_longjmp(png, 1);
  }

  static void give(png_structp png, png_bytep to, png_size_t count) {
    auto& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest_;
    if (count > rest.size()) png_error(png, "it ends early");
    std::memcpy(to, rest.data(), count);
    rest.remove_prefix(count);
  }

  /// Palettes become colours, small samples whole bytes, and a transparent colour a channel of its own.
  void expand() {
    png_set_expand(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
  }

  std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
  bool is_wide() const { return png_get_bit_depth(png_, info_) == 16; }

  std::string_view rest_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char why_[128] = "";
  std::vector<std::uint8_t> rows_;
};

/// In thousandths of a sample: colours by the weights of ITU-R BT.601, as most programs weigh them.
std::uint32_t grey_of(const PngReader& png, std::size_t pixel) {
  if (png.channels() < 3) return 1000 * png.sample(pixel, 0);
  return 299 * png.sample(pixel, 0) + 587 * png.sample(pixel, 1) + 114 * png.sample(pixel, 2);
}

} // namespace

GreyPicture read_png(std::string_view bytes, double ground) {
  PngReader png(bytes);
  png.read();
  GreyPicture picture{png.width(), png.height(), {}};
  const bool has_alpha = png.channels() % 2 == 0;
  const double white = png.white();
  const std::size_t count = std::size_t{picture.width} * picture.height;
  picture.shade.reserve(count);
  for (std::size_t pixel = 0; pixel < count; ++pixel) {
    const double shade = grey_of(png, pixel) / 1000.0 / white;
    const std::uint32_t alpha = has_alpha ? png.sample(pixel, png.channels() - 1) : png.white();
    if (alpha < png.white()) ++picture.transparent;
    const double share = alpha / white;
    picture.shade.push_back(alpha == png.white() ? shade : share * shade + (1 - share) * ground);
  }
  return picture;
}

} // namespace hopmesh::files
