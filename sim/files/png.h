// Pictures in colour on their way into PNG files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::files {

/// RGBA, eight bits each, from the top left.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// The bytes of a PNG file.
std::string encode_png(const Picture& picture);

} // namespace hopmesh::files
