#include "tests/house/page_tables.h"

#include "firmware/registers.h"

#include <cstdio>
#include <map>
#include <sstream>

namespace hopmesh::tests {

namespace {

std::string hex(std::uint32_t value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%0*X", digits, static_cast<unsigned>(value));
  return text;
}

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string register_table() {
  std::string table = "| register | offset | access | reset | meaning |\n|---|---|---|---|---|\n";
#define HM_X(name, offset, access, reset, meaning)                                                           \
  table += "| `" #name "` | " + hex(offset, 3) + " | " #access " | " +                                       \
           (offset >= HM_REG_CAP_CELLS && offset < HM_REG_CONTROL ? "as built" : hex(reset, 1)) + " | " +    \
           cell(meaning) + " |\n";
  HM_REGISTERS(HM_X)
#undef HM_X
  return table;
}

std::string window_table() {
  std::string table = "| window | base | access | content |\n|---|---|---|---|\n";
#define HM_X(name, base, access, meaning)                                                                    \
  table += "| `" #name "` | " + hex(base, 8) + " | " #access " | " + cell(meaning) + " |\n";
  HM_WINDOWS(HM_X)
#undef HM_X
  return table;
}

template <class Column, std::size_t n> std::vector<Column> all(const Column (&columns)[n]) {
  return {std::begin(columns), std::end(columns)};
}

} // namespace

std::string page_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& text : cells) row += text.empty() ? " |" : " " + cell(text) + " |";
  return row + "\n";
}

std::string with_tables(const std::string& page) {
  const std::map<std::string, std::string> tables{
      {"<!-- table registers -->", register_table()},
      {"<!-- table windows -->", window_table()},
      {"<!-- table steps -->", step_table(all(levels::all_step_columns))},
      {"<!-- table results -->", result_table(all(study::all_result_columns))}};
  std::istringstream in(page);
  std::string printed;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "<!-- end -->") inside = false;
    if (!inside) printed += line + "\n";
    if (const auto table = tables.find(line); table != tables.end()) {
      printed += table->second;
      inside = true;
    }
  }
  return printed;
}

} // namespace hopmesh::tests
