// Rows that prove themselves: whatever changes in the text of a kept table, it is told by its line and set
// aside.
#include "sim/files/csv.h"
#include "sim/files/kept_file.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace files;
using testing::HasSubstr;

class KeptFile : public ::testing::Test {
 protected:
  KeptFile() {
    CsvWriter table(file, columns, CheckedRows());
    table.cell("a, \"b\"\nc").cell(0.1).end_row();
    table.cell("d").cell(7).end_row();
    table.commit();
    whole = content_of(file);
  }
  std::string fault_of(const std::string& text) {
    write_text(file, text);
    return complaint<DamagedFile>([&] { read_kept(file, columns); });
  }

  const Folder folder;
  const std::filesystem::path file = folder / "kept.csv";
  const std::vector<std::string> columns{"name", "value"};
  std::string whole;
};

TEST_F(KeptFile, ComesBackAsItWasWritten) {
  const CsvTable table = read_kept(file, columns);
  EXPECT_EQ(table.header, columns);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a, \"b\"\nc", "0.1"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"d", "7"}));
}

TEST_F(KeptFile, EveryChangedByteIsFound) {
  for (std::size_t k = 0; k + 1 < whole.size(); ++k) {
    std::string text = whole;
    text[k] = static_cast<char>(text[k] ^ 1);
    EXPECT_NE(fault_of(text), "") << k;
    EXPECT_FALSE(std::filesystem::exists(file)) << k;
    EXPECT_EQ(content_of(file.string() + ".damaged"), text) << k;
  }
}

// Rows that are gone altogether are found by those who know how many there are.
TEST_F(KeptFile, WhatIsCutIsFound) {
  const std::size_t second = whole.rfind("d,7");
  for (std::size_t k = 0; k + 1 < whole.size(); ++k) {
    const std::size_t header = whole.find('\n');
    const bool between_rows = k == header || k == header + 1 || k == second - 1 || k == second;
    if (between_rows) continue;
    EXPECT_NE(fault_of(whole.substr(0, k)), "") << k;
  }
}

TEST_F(KeptFile, TheSentenceHasPlaceAndWayOut) {
  std::string text = whole;
  text.replace(text.rfind("d,7"), 3, "d,8");
  const std::string fault = fault_of(text);
  EXPECT_THAT(fault, HasSubstr(file.string() + ":4: check: found a damaged row, "));
  EXPECT_THAT(fault, HasSubstr("set aside as kept.csv.damaged, and the same command makes it again"));
}

TEST_F(KeptFile, OtherColumnsAreTold) {
  EXPECT_THAT(fault_of("name,other\n"),
              HasSubstr("kept.csv:1: found other columns, expected \"name,value,check\""));
}

TEST_F(KeptFile, IsToldInALineOfUtf8WhateverTheDamage) {
  EXPECT_THAT(set_aside(file, "values of type '\x01\xFF'").what(), HasSubstr("type '\\x01\\xFF'; set"));
}

} // namespace
} // namespace hopmesh::tests
