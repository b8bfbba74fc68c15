// What a scene may ask for at most, and the names it may pin by.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::scene {

/// Far above what an array is built for, far below what fills a machine's memory by a slip of the pen.
inline constexpr std::int64_t most_nodes = 4'000'000;
/// Of steps and sweeps: years of any machine.
inline constexpr double most_count = 1e9;

inline const std::vector<std::string> pin_names{"left", "right", "top", "bottom", "corners"};

} // namespace hopmesh::scene
