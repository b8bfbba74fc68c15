// A C header that stands alone: offsets, resets, and shift and mask of each field.
#include "rtl_model/describe/register_rows.h"

namespace hopmesh::describe {

namespace {

std::string define(const std::string& name, const std::string& value) {
  return "#define HOPMESH_" + name + " " + value + "u\n";
}

std::uint32_t mask_of(const FieldRow& field) {
  return 0xFFFFFFFFu >> (32 - field.width) << field.lowest;
}

} // namespace

std::string c_text() {
  std::string text =
      "/* Registers of a Hopmesh array, version " + version_text() +
      ". Offsets are bytes; every register has 32 bits.\n   RO read only; RW read and write; WO "
      "written only; W1C a written 1 clears the bit.\n   Made by print_registers. */\n"
      "#ifndef HOPMESH_REGISTERS_H\n#define HOPMESH_REGISTERS_H\n";
  for (const RegisterRow& row : register_rows()) {
    text += "\n/* " + row.name + ", " + name_of(row.access) + ": " + row.meaning + " */\n";
    text += define(row.name + "_OFFSET", hex(row.offset, 3));
    if (!row.as_built) text += define(row.name + "_RESET", hex(row.reset));
    for (const FieldRow& field : row.fields) {
      if (field.width < 32) text += "/* " + field.meaning + " */\n";
      text += define(row.name + "_" + field.name + "_SHIFT", std::to_string(field.lowest));
      text += define(row.name + "_" + field.name + "_MASK", hex(mask_of(field), 8));
    }
  }
  text += "\n/* Windows, behind the registers, in this order. Their places stand in CAP_WINDOW_ registers.\n";
  for (const WindowRow& row : window_rows())
    text += "   " + row.name + ", " + name_of(row.access) + ": " + row.meaning + "\n";
  return text + "*/\n\n#endif\n";
}

} // namespace hopmesh::describe
