#include "sim/input/utf8.h"

#include "sim/input/input_error.h"

#include <cstdint>

namespace hopmesh::input {

namespace {

/// How many bytes follow a first byte; -1 where it can be none.
int bytes_behind(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

bool is_code(std::uint32_t code, int behind) {
  constexpr std::uint32_t least[] = {0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= least[behind] && code <= 0x10FFFF && !surrogate;
}

} // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at++]);
    const int behind = bytes_behind(first);
    if (behind < 0) return false;
    std::uint32_t code = behind == 0 ? first : first & (0x3Fu >> behind);
    for (int k = 0; k < behind; ++k, ++at) {
      const auto next = at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
      if ((next & 0xC0u) != 0x80u) return false;
      code = code << 6 | (next & 0x3Fu);
    }
    if (!is_code(code, behind)) return false;
  }
  return true;
}

void expect_utf8(const std::string& place, const std::string& text) {
  if (!is_utf8(text)) throw input_error("", 0, place, in_quotes(text), "UTF-8");
}

} // namespace hopmesh::input
