#include "sim/pictures/overlay.h"

#include "sim/files/png.h"
#include "sim/pictures/base64.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::pictures {
namespace {

std::string png_of(const files::GreyPicture& picture) {
  files::Picture colours{picture.width, picture.height, {}};
  for (const double shade : picture.shade) {
    const auto byte = static_cast<std::uint8_t>(std::lround(shade * 255));
    colours.rgba.insert(colours.rgba.end(), {byte, byte, byte, 255});
  }
  return files::encode_png(colours);
}

// The middle of the first pixel stands half a pixel inside the picture.
std::string path_of(const std::vector<OverlayLine>& lines, const char* colour, double width) {
  std::string d;
  for (const OverlayLine& edge : lines)
    d += fmt::format("M{:.3f} {:.3f}L{:.3f} {:.3f}", edge.from[0] + 0.5, edge.from[1] + 0.5, edge.to[0] + 0.5,
                     edge.to[1] + 0.5);
  return fmt::format(
      "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" fill=\"none\"/>\n", d,
      colour, width);
}

} // namespace

void write_overlay(const std::filesystem::path& path, const files::GreyPicture& picture,
                   const std::vector<OverlayLine>& start, const std::vector<OverlayLine>& end) {
  const double thin = std::max(picture.width, picture.height) / 250.0;
  const std::uint32_t zoom = std::max(1u, 512 / std::max(picture.width, picture.height));
  files::OutputFile file(path);
  file.write(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{2}\" "
                         "height=\"{3}\">\n<image width=\"{0}\" height=\"{1}\" "
                         "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,",
                         picture.width, picture.height, picture.width * zoom, picture.height * zoom));
  const std::string png = png_of(picture);
  Base64Writer digits(file);
  digits.bytes(png.data(), png.size());
  digits.end();
  file.write("\"/>\n");
  file.write(path_of(start, "#3c8dd9", thin));
  file.write(path_of(end, "#ff7a1a", 2 * thin));
  file.write("</svg>\n");
  file.commit();
}

} // namespace hopmesh::pictures
