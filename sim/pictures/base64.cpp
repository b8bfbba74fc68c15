#include "sim/pictures/base64.h"

#include <algorithm>

// The library that writes glTF has this function, but its header shows it only to the library itself.
namespace tinygltf {
std::string base64_encode(unsigned char const* bytes, unsigned int count);
}

namespace hopmesh::pictures {

void Base64Writer::bytes(const void* data, std::size_t count) {
  constexpr std::size_t block = 3 * 1024; // whole groups of three: nothing is padded before the end
  const auto* at = static_cast<const char*>(data);
  while (count > 0) {
    const std::size_t part = std::min(count, block - waiting_.size());
    waiting_.append(at, part);
    at += part, count -= part;
    if (waiting_.size() == block) end();
  }
}

void Base64Writer::end() {
  file_.write(tinygltf::base64_encode(reinterpret_cast<const unsigned char*>(waiting_.data()),
                                      static_cast<unsigned>(waiting_.size())));
  waiting_.clear();
}

} // namespace hopmesh::pictures
