// CMSIS-SVD 1.3: a device of one peripheral, for debuggers.
#include "rtl_model/describe/xml_lines.h"

namespace hopmesh::describe {

namespace {

void add_field(XmlLines& xml, const FieldRow& field) {
  begin_field(xml, field);
  xml.line("bitWidth", std::to_string(field.width));
  xml.line("access", xml_access(field.access));
  if (field.access == Access::W1C) xml.line("modifiedWriteValues", "oneToClear");
  xml.close("field");
}

void add_register(XmlLines& xml, const RegisterRow& row) {
  begin_register(xml, row, hex(row.offset, 3));
  if (!row.as_built) xml.line("resetValue", hex(row.reset));
  xml.open("fields");
  for (const FieldRow& field : row.fields) add_field(xml, field);
  xml.close("fields");
  xml.close("register");
}

void add_peripheral(XmlLines& xml) {
  xml.open("peripheral");
  xml.line("name", "HOPMESH");
  xml.line("description", "Windows lie behind the registers, where the CAP_WINDOW registers tell.");
  xml.line("baseAddress", "0x0");
  xml.open("addressBlock");
  xml.line("offset", "0x0");
  xml.line("size", "0x1000");
  xml.line("usage", "registers");
  xml.close("addressBlock");
  xml.open("registers");
  for (const RegisterRow& row : register_rows()) add_register(xml, row);
  xml.close("registers");
  xml.close("peripheral");
}

} // namespace

std::string svd_text() {
  XmlLines xml("");
  xml.open("device", " schemaVersion=\"1.3\" xmlns:xs=\"http://www.w3.org/2001/XMLSchema-instance\" "
                     "xs:noNamespaceSchemaLocation=\"CMSIS-SVD.xsd\"");
  xml.line("name", "HOPMESH");
  xml.line("version", version_text());
  xml.line("description", "A neural-network array behind a host bus; its base address is the platform's.");
  xml.line("addressUnitBits", "8");
  xml.line("width", "32");
  xml.open("peripherals");
  add_peripheral(xml);
  xml.close("peripherals");
  xml.close("device");
  return xml.text();
}

} // namespace hopmesh::describe
