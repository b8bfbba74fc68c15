// A sentence per mistake, always one printable line, whatever bytes the mistake was made of.
#include "sim/input/input_error.h"

#include "sim/input/utf8.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace hopmesh::input {

namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A key of hundreds of kilobytes is told by its beginning.
std::string shortened(const std::string& key) {
  constexpr std::size_t longest = 200;
  return key.size() > longest ? key.substr(0, longest) + "..." : key;
}

/// Edit distance with neighbouring letters swapped counted as one mistake (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above[b.size()];
}

} // namespace

std::string as_a_line(const std::string& text) {
  const bool legible = is_utf8(text);
  std::string line;
  for (char c : text)
    line += is_control(c) || (!legible && !is_ascii(c))
                ? fmt::format("\\x{:02X}", static_cast<unsigned char>(c))
                : std::string(1, c);
  return line;
}

InputError input_error(const std::string& file, int line, const std::string& key, const std::string& found,
                       const std::string& expected, const std::string& nearest) {
  std::string text = file;
  if (line > 0) text += fmt::format("{}{}", text.empty() ? "line " : ":", line);
  if (!key.empty()) text += (text.empty() ? "" : ": ") + shortened(key);
  std::string sentence = found.empty() ? "" : "found " + found;
  if (!expected.empty()) sentence += (sentence.empty() ? "expected " : ", expected ") + expected;
  if (!nearest.empty()) sentence += " (did you mean " + nearest + "?)";
  return InputError(as_a_line(text + (text.empty() || sentence.empty() ? "" : ": ") + sentence));
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& valid) {
  constexpr std::size_t longest = 100; // longer ones are no typing mistakes
  if (name.size() > longest) return "";
  std::size_t limit = std::max<std::size_t>(1, (name.size() + 1) / 3);
  std::string nearest;
  for (const std::string& candidate : valid) {
    const std::size_t distance = edit_distance(lower(name), lower(candidate));
    if (distance > limit || 2 * distance > candidate.size()) continue;
    nearest = candidate;
    if (distance == 0) break;
    limit = distance - 1;
  }
  return nearest;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string shown;
  for (char c : text.substr(0, longest))
    shown += is_ascii(c) && !is_control(c) ? std::string(1, c)
                                           : fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
  return '"' + shown + (text.size() > longest ? "...\"" : "\"");
}

} // namespace hopmesh::input
