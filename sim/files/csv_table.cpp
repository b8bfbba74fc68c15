#include "sim/files/csv_table.h"

#include "sim/input/number.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace hopmesh::files {

namespace {

/// A cell, from `at` on; leaves `at` behind its comma or on its line's end.
std::string take_cell(std::string_view text, std::size_t& at) {
  std::string cell;
  bool quoted = at < text.size() && text[at] == '"';
  if (quoted) ++at;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '"') {
      if (at + 1 < text.size() && text[at + 1] == '"')
        ++at;
      else {
        quoted = false;
        continue;
      }
    } else if (!quoted && (c == ',' || c == '\n')) {
      break;
    }
    cell += c;
  }
  return cell;
}

std::vector<std::string> take_row(std::string_view text, std::size_t& at) {
  std::vector<std::string> row{take_cell(text, at)};
  while (at < text.size() && text[at] == ',') row.push_back(take_cell(text, ++at));
  ++at;
  return row;
}

} // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  for (std::size_t k = 0; k < header.size(); ++k)
    if (header[k] == name) return k;
  return std::nullopt;
}

const std::string& CsvTable::text(std::size_t row, std::string_view name) const {
  static const std::string none;
  const auto k = column(name);
  return k ? rows[row][*k] : none;
}

std::optional<double> CsvTable::number(std::size_t row, std::string_view name) const {
  double value = 0;
  if (!input::parse_number(text(row, name), value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

CsvTable parse_csv(std::string_view text, const std::string& path) {
  CsvTable table;
  std::size_t at = 0;
  table.header = take_row(text, at);
  while (at < text.size()) {
    table.rows.push_back(take_row(text, at));
    if (table.rows.back().size() != table.header.size())
      throw std::runtime_error(fmt::format("{}: row {} has {} cells under a header of {}", path,
                                           table.rows.size(), table.rows.back().size(), table.header.size()));
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return parse_csv(std::string(std::istreambuf_iterator<char>(file), {}), path.string());
}

} // namespace hopmesh::files
