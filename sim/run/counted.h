// A number beside its noun, for people: "1 step", "1,140 steps".
#pragma once

#include "sim/run/array_info.h"

namespace hopmesh::run {

/// Of a noun whose plural has an s.
inline std::string counted(std::uint64_t number, const std::string& noun) {
  return grouped(number) + ' ' + noun + (number == 1 ? "" : "s");
}

} // namespace hopmesh::run
