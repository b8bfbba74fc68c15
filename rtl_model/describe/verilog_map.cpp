// What the register file of the RTL asks of the table: addresses, resets, fields, who may write.
#include "rtl_model/describe/register_rows.h"

namespace hopmesh::describe {

namespace {

std::string constant(const std::string& type, const std::string& name, const std::string& value) {
  return "localparam " + type + " HM_" + name + " = " + value + ";\n";
}

std::string word(std::uint32_t value) {
  return "32'h" + hex(value).substr(2);
}

/// A bit for each register that `is` says so of, by a quarter of its offset.
template <typename Is> std::string mask(const Is& is) {
  std::string text(16, '0');
  for (const RegisterRow& row : register_rows()) {
    if (!is(row)) continue;
    char& digit = text.at(15 - row.offset / 16);
    const int bits = (digit <= '9' ? digit - '0' : digit - 'a' + 10) | 1 << row.offset / 4 % 4;
    digit = "0123456789abcdef"[bits];
  }
  return "64'h" + text;
}

} // namespace

std::string verilog_text() {
  std::string text = "// Registers of a Hopmesh array, version " + version_text() +
                     ", for the modules of its RTL. Made by print_registers.\n// verilator lint_off UNUSED\n";
  for (const RegisterRow& row : register_rows())
    text += constant("[31:0]", "REG_" + row.name, word(row.offset));
  for (const RegisterRow& row : register_rows())
    if (!row.as_built) text += constant("[31:0]", "RESET_" + row.name, word(row.reset));
  for (const RegisterRow& row : register_rows())
    for (const FieldRow& field : row.fields)
      if (field.width < 32)
        text += constant("[31:0]", row.name + "_" + field.name, std::to_string(field.lowest));
  for (const RegisterRow& row : register_rows())
    if (row.as_built) {
      text += constant("[31:0]", "FIRST_CAPABILITY", std::to_string(row.offset / 4));
      break;
    }
  text += constant("[63:0]", "REGISTERS", mask([](const RegisterRow&) { return true; }));
  text +=
      constant("[63:0]", "WRITABLE", mask([](const RegisterRow& row) { return row.access != Access::RO; }));
  return text + "// verilator lint_on UNUSED\n";
}

} // namespace hopmesh::describe
