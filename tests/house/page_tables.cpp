#include "tests/house/page_tables.h"

#include "rtl_model/describe/register_rows.h"

#include <map>
#include <sstream>

namespace hopmesh::tests {

namespace {

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
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
      {"<!-- table registers -->", describe::register_table()},
      {"<!-- table fields -->", describe::field_table()},
      {"<!-- table windows -->", describe::window_table()},
      {"<!-- table steps -->", step_table(all(levels::all_step_columns))},
      {"<!-- table results -->", result_table(all(study::all_result_columns))},
      {"<!-- table scene_keys -->", scene_table()},
      {"<!-- table array_keys -->", array_table()},
      {"<!-- table presets -->", preset_table()}};
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
