// Pictures as they come in: PGM and PNG files to shades of grey.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace hopmesh::files {

/// From the top left, row by row; 0: black, 1: white.
struct GreyPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<double> shade;
  std::size_t transparent = 0; ///< pixels that let something of the ground through

  double at(std::uint32_t row, std::uint32_t column) const {
    return shade[std::size_t{row} * width + column];
  }
};

/// Why bytes are no picture; what() says what was found.
class NoPicture : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From the bytes of a PGM (P2 or P5) or PNG file. Samples count as they are written, without regard to
/// gamma; of a colour 0.299 red, 0.587 green, 0.114 blue. Transparent pixels lie on the shade `ground`.
/// Throws NoPicture.
GreyPicture read_grey(std::string_view bytes, double ground = 0);

} // namespace hopmesh::files
