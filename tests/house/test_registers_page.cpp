// docs/hardware/registers.md shows the register table as it is.
#include "firmware/registers.h"
#include "tests/house/register_tables.h"
#include "tests/house/tree.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

TEST(RegistersPage, showsTheTableAsItIs) {
  const std::string page = text_of(registers_page);
  EXPECT_EQ(page, with_tables(page)) << "stale: run build-check/print_registers docs/hardware/registers.md";
}

TEST(RegistersPage, showsEveryRegisterAndWindow) {
  const std::string page = text_of(registers_page);
#define HM_X(name, ...) EXPECT_NE(page.find("| `" #name "` | 0x"), std::string::npos) << #name;
  HM_REGISTERS(HM_X)
  HM_WINDOWS(HM_X)
#undef HM_X
}

TEST(RegistersPage, anOldTableIsReplaced) {
  const std::string page = "before\n<!-- table windows -->\n| old |\n<!-- end -->\nafter\n";
  const std::string printed = with_tables(page);
  EXPECT_EQ(printed.find("| old |"), std::string::npos);
  EXPECT_NE(printed.find("| `LINK` | 0x20000000 | RO |"), std::string::npos);
  EXPECT_EQ(printed.substr(printed.size() - 19), "<!-- end -->\nafter\n");
}

} // namespace
} // namespace hopmesh::tests
