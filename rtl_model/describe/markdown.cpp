// Markdown: the tables of docs/hardware/registers.md, and a page that stands alone.
#include "rtl_model/describe/register_rows.h"

namespace hopmesh::describe {

namespace {

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string bits(const FieldRow& field) {
  const std::string lowest = std::to_string(field.lowest);
  return field.width == 1 ? lowest : std::to_string(field.lowest + field.width - 1) + ":" + lowest;
}

} // namespace

std::string register_table() {
  std::string table = "| register | offset | access | reset | meaning |\n|---|---|---|---|---|\n";
  for (const RegisterRow& row : register_rows())
    table += "| `" + row.name + "` | " + hex(row.offset, 3) + " | " + name_of(row.access) + " | " +
             (row.as_built ? "as built" : hex(row.reset)) + " | " + cell(row.meaning) + " |\n";
  return table;
}

std::string field_table() {
  std::string table = "| register | bits | field | meaning |\n|---|---|---|---|\n";
  for (const RegisterRow& row : register_rows())
    for (const FieldRow& field : row.fields)
      if (field.width < 32)
        table += "| `" + row.name + "` | " + bits(field) + " | `" + field.name + "` | " +
                 cell(field.meaning) + " |\n";
  return table;
}

std::string window_table() {
  std::string table = "| window | access | content |\n|---|---|---|\n";
  for (const WindowRow& row : window_rows())
    table += "| `" + row.name + "` | " + name_of(row.access) + " | " + cell(row.meaning) + " |\n";
  return table;
}

std::string markdown_text() {
  return "# Registers of a Hopmesh array, version " + version_text() + "\n\n" + register_table() +
         "\n## Fields\n\nA register that is not in this table is one number of 32 bits. Bits of no field "
         "read as 0.\n\n" +
         field_table() + "\n## Windows\n\n" + window_table();
}

} // namespace hopmesh::describe
