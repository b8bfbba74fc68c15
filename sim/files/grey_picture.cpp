#include "sim/files/grey_formats.h"
#include "sim/input/number.h"

#include <algorithm>
#include <string>

namespace hopmesh::files {
namespace {

constexpr std::uint32_t most_side = 16384;
constexpr const char* blanks = " \t\r\n";

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

  /// The pixels of a picture in bytes: one blank parts them from the header. Where that is the first of a
  /// line end of two, a byte is left over at the end and tells.
  std::string_view bytes(std::size_t wanted) const {
    std::string_view raw = rest_.substr(rest_.empty() ? 0 : 1);
    if (raw.size() == wanted + 1 && rest_.substr(0, 2) == "\r\n") raw.remove_prefix(1);
    if (raw.size() < wanted) throw NoPicture("a PGM picture that ends early");
    if (raw.find_first_not_of(blanks, wanted) != std::string_view::npos)
      throw NoPicture("a PGM picture with " + std::to_string(raw.size() - wanted) +
                      " bytes behind its pixels");
    return raw.substr(0, wanted);
  }

 private:
  void skip() {
    for (;;) {
      const auto first = rest_.find_first_not_of(blanks);
      rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
      if (rest_.empty() || rest_.front() != '#') return;
      rest_.remove_prefix(std::min(rest_.size(), rest_.find('\n')));
    }
  }

  std::string_view rest_;
};

} // namespace

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
  const std::string_view raw = plain ? "" : numbers.bytes(count * wide);
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

GreyPicture read_grey(std::string_view bytes, double ground) {
  if (bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5')) return read_pgm(bytes);
  if (bytes.substr(0, 4) == "\x89PNG") return read_png(bytes, ground);
  throw NoPicture("no picture");
}

} // namespace hopmesh::files
