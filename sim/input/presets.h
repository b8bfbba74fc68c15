// The arrays that have a name, as people are told of them.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::input {

struct PresetWords {
  std::string name, words;
  bool is_default;
};
std::vector<PresetWords> preset_words();

} // namespace hopmesh::input
