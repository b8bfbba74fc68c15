// The flag's own picture: a golden shield with a mesh of hops on deep blue cloth, drawn from formulas. Drawn
// once, when the program is built (flag_crest.h holds the result).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::record {

/// RGBA, eight bits each, from the top left.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// The same bytes at every call. The picture is square: it is stretched over flags of other shapes.
Picture draw_crest(std::uint32_t size);

/// The bytes of a PNG file.
std::string encode_png(const Picture& picture);

/// The crest as PNG.
std::string crest_png(std::uint32_t size);

} // namespace hopmesh::record
