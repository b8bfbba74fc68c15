// Draws what a format makes of numbers, as small SVG pictures for docs/hardware/number-formats.md.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace hopmesh::tests {

/// A staircase for |x| <= reach: `code` takes quarters of a last place. Steps may begin at halves and wholes;
/// a full dot marks the value taken there.
std::string draw_staircase(const std::string& title, int reach, const std::function<std::int64_t(int)>& code);

/// A dot for every whole x with |x| <= reach; heights up to `height`.
std::string draw_dots(const std::string& title, int reach, int height,
                      const std::function<std::int64_t(int)>& code);

} // namespace hopmesh::tests
