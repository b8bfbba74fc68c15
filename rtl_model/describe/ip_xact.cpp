// IP-XACT, IEEE 1685-2014: a component with one block of registers, for tools that put chips together.
#include "rtl_model/describe/xml_lines.h"

namespace hopmesh::describe {

namespace {

std::string number(std::uint32_t value) {
  return "'h" + hex(value).substr(2);
}

void add_field(XmlLines& xml, const RegisterRow& row, const FieldRow& field) {
  begin_field(xml, field);
  if (!row.as_built) {
    xml.open("resets");
    xml.open("reset");
    xml.line("value", number(row.reset >> field.lowest & 0xFFFFFFFFu >> (32 - field.width)));
    xml.close("reset");
    xml.close("resets");
  }
  xml.line("bitWidth", std::to_string(field.width));
  xml.line("access", xml_access(field.access));
  if (field.access == Access::W1C) xml.line("modifiedWriteValue", "oneToClear");
  xml.close("field");
}

void add_register(XmlLines& xml, const RegisterRow& row) {
  begin_register(xml, row, number(row.offset));
  for (const FieldRow& field : row.fields) add_field(xml, row, field);
  xml.close("register");
}

} // namespace

std::string ip_xact_text() {
  XmlLines xml("ipxact:");
  xml.open("component", " xmlns:ipxact=\"http://www.accellera.org/XMLSchema/IPXACT/1685-2014\"");
  xml.line("vendor", "hopmesh");
  xml.line("library", "hopmesh");
  xml.line("name", "array");
  xml.line("version", version_text());
  xml.open("memoryMaps");
  xml.open("memoryMap");
  xml.line("name", "host");
  xml.open("addressBlock");
  xml.line("name", "registers");
  xml.line("description", "Windows lie behind them, where the CAP_WINDOW registers tell.");
  xml.line("baseAddress", "'h0");
  xml.line("range", "'h1000");
  xml.line("width", "32");
  xml.line("usage", "register");
  for (const RegisterRow& row : register_rows()) add_register(xml, row);
  xml.close("addressBlock");
  xml.line("addressUnitBits", "8");
  xml.close("memoryMap");
  xml.close("memoryMaps");
  xml.close("component");
  return xml.text();
}

} // namespace hopmesh::describe
