// SystemRDL 2.0, for generators of registers.
#include "rtl_model/describe/register_rows.h"

namespace hopmesh::describe {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "\"";
}

/// What software may do, and what hardware does.
const char* properties(Access access) {
  switch (access) {
  case Access::RO:
    return "sw = r; hw = w;";
  case Access::RW:
    return "sw = rw; hw = r;";
  case Access::WO:
    return "sw = w; hw = r;";
  case Access::W1C:
    break;
  }
  return "sw = rw; hw = w; onwrite = woclr;";
}

std::string field_text(const RegisterRow& row, const FieldRow& field) {
  const std::uint32_t reset = row.reset >> field.lowest & 0xFFFFFFFFu >> (32 - field.width);
  return "    field { desc = " + quoted(field.meaning) + "; " + properties(field.access) + " } " +
         field.name + "[" + std::to_string(field.lowest + field.width - 1) + ":" +
         std::to_string(field.lowest) + "]" + (row.as_built ? "" : " = " + hex(reset)) + ";\n";
}

} // namespace

std::string system_rdl_text() {
  std::string text =
      "// Made by print_registers.\naddrmap hopmesh {\n  name = \"Hopmesh array\";\n  desc = "
      "\"Registers, version " +
      version_text() +
      ". Windows lie behind them, where the CAP_WINDOW registers tell.\";\n  default regwidth = "
      "32;\n  default accesswidth = 32;\n  littleendian;\n  lsb0;\n";
  for (const RegisterRow& row : register_rows()) {
    text += "\n  reg {\n    desc = " + quoted(row.meaning) + ";\n";
    for (const FieldRow& field : row.fields) text += field_text(row, field);
    text += "  } " + row.name + " @ " + hex(row.offset, 3) + ";\n";
  }
  return text + "};\n";
}

} // namespace hopmesh::describe
