// Whole numbers as people read them: "1,140", "1 step", "1,140 steps".
#pragma once

#include <cstdint>
#include <string>

namespace hopmesh::input {

/// 12345678 -> "12,345,678".
std::string grouped(std::uint64_t number);
/// Of a noun whose plural has an s.
std::string with_noun(std::uint64_t number, const std::string& noun);

} // namespace hopmesh::input
