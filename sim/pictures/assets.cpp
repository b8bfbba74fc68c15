#include "sim/pictures/assets.h"

#include <stdexcept>
#include <utility>
#include <vector>

namespace hopmesh::pictures {

/// Made during the build: hopmesh_embed of CMakeLists.txt.
const std::vector<std::pair<std::string, std::string>>& embedded_assets();

const std::string& asset(const std::string& name) {
  for (const auto& [file, bytes] : embedded_assets())
    if (file == name) return bytes;
  throw std::logic_error("no file " + name + " in the program");
}

} // namespace hopmesh::pictures
