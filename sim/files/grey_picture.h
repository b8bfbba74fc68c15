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

  double at(std::uint32_t row, std::uint32_t column) const {
    return shade[std::size_t{row} * width + column];
  }
};

/// Why bytes are no picture; what() says what was found.
class NoPicture : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From the bytes of a PGM (P2 or P5) or PNG file; colours become their brightness. Throws NoPicture.
GreyPicture read_grey(std::string_view bytes);

} // namespace hopmesh::files
