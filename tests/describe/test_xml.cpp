// IP-XACT and SVD, read by a reader of XML that knows nothing of how they were made, and held against the one
// table.
#include "tests/describe/told_table.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace hopmesh::tests {
namespace {

std::string access_of(const std::string& words, bool one_clears) {
  if (words == "read-only") return "RO";
  if (words == "write-only") return "WO";
  return words == "read-write" ? one_clears ? "W1C" : "RW" : words;
}

std::string text_of(const pugi::xml_node& node, const std::string& child) {
  return node.child(child.c_str()).text().as_string();
}

Told told_by_svd(const pugi::xml_node& node, const char* offset) {
  Told t;
  t.name = text_of(node, "name");
  t.meaning = text_of(node, "description");
  t.offset = number(text_of(node, offset));
  t.access = access_of(text_of(node, "access"), text_of(node, "modifiedWriteValues") == "oneToClear");
  if (node.child("bitWidth")) t.width = number(text_of(node, "bitWidth"));
  if (node.child("resetValue")) t.reset = number(text_of(node, "resetValue"));
  return t;
}

/// What software may do with a register is what it may do with its fields: a W1C register is read and
/// written.
void take_access_of_fields(Told& t) {
  if (!t.fields.empty() && t.fields[0].access == "W1C" && t.access == "RW") t.access = "W1C";
}

TEST(Descriptions, SvdTellsTheTable) {
  pugi::xml_document svd;
  ASSERT_TRUE(svd.load_string(file_text("svd").c_str()));
  const pugi::xml_node device = svd.child("device");
  EXPECT_STREQ(device.attribute("schemaVersion").value(), "1.3");
  EXPECT_EQ(text_of(device, "version"), "2.1");
  EXPECT_EQ(text_of(device, "width"), "32");
  std::vector<Told> found;
  const pugi::xml_node peripheral = device.child("peripherals").child("peripheral");
  EXPECT_EQ(number(text_of(peripheral.child("addressBlock"), "size")), std::uint32_t{HM_REGISTER_BYTES});
  for (const pugi::xml_node node : peripheral.child("registers").children("register")) {
    found.push_back(told_by_svd(node, "addressOffset"));
    EXPECT_EQ(text_of(node, "size"), "32");
    for (const pugi::xml_node field : node.child("fields").children("field"))
      found.back().fields.push_back(told_by_svd(field, "bitOffset"));
    take_access_of_fields(found.back());
  }
  EXPECT_EQ(found, table(true, false, true));
}

Told told_by_ip_xact(const pugi::xml_node& node, const char* offset) {
  Told t;
  t.name = text_of(node, "ipxact:name");
  t.meaning = text_of(node, "ipxact:description");
  t.offset = number(text_of(node, offset));
  t.access =
      access_of(text_of(node, "ipxact:access"), text_of(node, "ipxact:modifiedWriteValue") == "oneToClear");
  if (node.child("ipxact:bitWidth")) t.width = number(text_of(node, "ipxact:bitWidth"));
  const auto reset = node.child("ipxact:resets").child("ipxact:reset").child("ipxact:value");
  if (reset) t.reset = number(reset.text().as_string());
  return t;
}

/// The order of elements that the schema asks for.
void expect_order(const pugi::xml_node& node, const std::vector<std::string>& order) {
  std::size_t at = 0;
  for (const pugi::xml_node child : node.children()) {
    while (at < order.size() && "ipxact:" + order[at] != child.name()) ++at;
    ASSERT_LT(at, order.size()) << child.name() << " of " << text_of(node, "ipxact:name");
  }
}

TEST(Descriptions, IpXactTellsTheTable) {
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(file_text("xml").c_str()));
  const pugi::xml_node component = xml.child("ipxact:component");
  EXPECT_STREQ(component.attribute("xmlns:ipxact").value(),
               "http://www.accellera.org/XMLSchema/IPXACT/1685-2014");
  EXPECT_EQ(text_of(component, "ipxact:version"), "2.1");
  expect_order(component, {"vendor", "library", "name", "version", "memoryMaps"});
  const pugi::xml_node block =
      component.child("ipxact:memoryMaps").child("ipxact:memoryMap").child("ipxact:addressBlock");
  EXPECT_EQ(number(text_of(block, "ipxact:range")), std::uint32_t{HM_REGISTER_BYTES});
  std::vector<Told> found;
  for (const pugi::xml_node node : block.children("ipxact:register")) {
    found.push_back(told_by_ip_xact(node, "ipxact:addressOffset"));
    expect_order(node, {"name", "description", "addressOffset", "size", "volatile", "access", "field"});
    for (const pugi::xml_node field : node.children("ipxact:field")) {
      found.back().fields.push_back(told_by_ip_xact(field, "ipxact:bitOffset"));
      expect_order(field, {"name", "description", "bitOffset", "resets", "bitWidth", "volatile", "access",
                           "modifiedWriteValue", "readAction"});
    }
    take_access_of_fields(found.back());
  }
  EXPECT_EQ(found, table(false, true, true));
}

} // namespace
} // namespace hopmesh::tests
