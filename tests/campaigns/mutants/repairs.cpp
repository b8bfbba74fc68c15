#include "tests/campaigns/mutants/repairs.h"

#include "sim/files/csv.h"
#include "sim/run/checked_lines.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hopmesh::campaigns {

namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// As the PNG specification has it.
std::uint32_t crc_of(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint32_t crc = ~0u;
  for (std::size_t k = at; k < at + size; ++k) {
    crc ^= static_cast<unsigned char>(bytes[k]);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// Calls `mend` with each line without its end, and puts what comes of it in its place.
template <class Mend> std::string each_line(const std::string& bytes, Mend mend) {
  std::string mended;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    mended += mend(bytes.substr(at, end - at));
    if (end < bytes.size()) mended += '\n';
    at = end + 1;
  }
  return mended;
}

} // namespace

void repair_png(std::string& bytes) {
  constexpr std::size_t signature = 8, around = 12; // length, type and check
  for (std::size_t at = signature; at + around <= bytes.size();) {
    const std::size_t size = big_endian(bytes, at);
    if (size > bytes.size() - at - around) return;
    const std::uint32_t crc = crc_of(bytes, at + 4, size + 4);
    for (std::size_t k = 0; k < 4; ++k) bytes[at + 8 + size + k] = static_cast<char>(crc >> (24 - 8 * k));
    at += size + around;
  }
}

void repair_rows(std::string& bytes) {
  bool header = true;
  bytes = each_line(bytes, [&](const std::string& line) {
    const std::size_t comma = line.rfind(',');
    if (std::exchange(header, false) || comma == std::string::npos) return line;
    const std::string row = line.substr(0, comma);
    return row + ',' + files::check_of_row(row);
  });
}

void repair_checkpoint(std::string& bytes) {
  constexpr std::size_t check = 17; // sixteen digits and a blank
  run::CheckedLines lines;
  std::size_t at = 0;
  for (bool last = false; !last && at < bytes.size();) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string::npos || end < at + check) break;
    std::string_view text = std::string_view(bytes).substr(at + check, end - at - check);
    const std::string key(run::first_word(text));
    lines.add(key, std::string(text));
    last = key == "binary";
    at = end + 1;
  }
  bytes.replace(0, at, lines.text());
}

} // namespace hopmesh::campaigns
