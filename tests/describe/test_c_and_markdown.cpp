// The C header, as a compiler takes it, and the Markdown page, held against the one table; and the program
// that writes them.
#include "tests/describe/told_table.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <hopmesh_registers.h>

namespace hopmesh::tests {
namespace {

// ---- C ----

/// The header is included above, beside the table that it was made of: it stands alone, and no name clashes.
TEST(Descriptions, TheHeaderTellsTheTable) {
#define HM_X(name, offset, access, reset, meaning) EXPECT_EQ(HOPMESH_##name##_OFFSET, unsigned{offset});
  HM_REGISTERS(HM_X)
#undef HM_X
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  EXPECT_EQ(HOPMESH_##reg##_##field##_SHIFT, unsigned{lowest});                                              \
  EXPECT_EQ(HOPMESH_##reg##_##field##_MASK, HM_MASK_##reg##_##field);
  HM_FIELDS(HM_X)
#undef HM_X
  EXPECT_EQ(HOPMESH_ID_RESET, HM_ID_VALUE);
  EXPECT_EQ(HOPMESH_VERSION_RESET, HM_VERSION_VALUE);
  EXPECT_EQ(HOPMESH_MAX_SWEEPS_RESET, 1u);
  std::size_t defines = 0, wanted = 1; // its guard
  for (const std::string& line : lines_of(file_text("h"))) defines += line.rfind("#define ", 0) == 0;
  for (const Told& row : table()) wanted += 1 + row.reset.has_value() + 2 * row.fields.size();
  EXPECT_EQ(defines, wanted);
}

TEST(Descriptions, TheHeaderIsPlainC) {
  const std::string header = std::string(HOPMESH_BINARY_DIR) + "/registers/hopmesh_registers.h";
  const Folder folder;
  const std::string source =
      folder.write("alone.c", "#include \"" + header + "\"\nint word = HOPMESH_CONTROL_ABORT_MASK;\n");
  const Finished compiled = run_shell("cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only " + source);
  EXPECT_EQ(compiled.exit_code, 0) << compiled.err;
}

// ---- Markdown ----

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t k = 1; k < line.size(); ++k)
    if (line[k] == '|' && line[k - 1] != '\\') {
      cells.push_back(cell.size() > 1 ? cell.substr(1, cell.size() - 2) : "");
      cell.clear();
    } else if (line[k] == '|') {
      cell.back() = '|';
    } else {
      cell += line[k];
    }
  return cells;
}

std::string without_ticks(const std::string& text) {
  return text.substr(1, text.size() - 2);
}

/// Whole words have no row among the fields.
TEST(Descriptions, MarkdownTellsTheTable) {
  std::vector<Told> found;
  for (const std::string& line : lines_of(file_text("md"))) {
    const auto cells = cells_of(line);
    if (cells.size() == 5 && cells[1].rfind("0x", 0) == 0) {
      found.push_back({without_ticks(cells[0]), cells[4], cells[2], number(cells[1]), 0, {}, {}});
      if (cells[3] != "as built") found.back().reset = number(cells[3]);
    }
    if (cells.size() != 4 || cells[1].find_first_not_of("0123456789:") != std::string::npos) continue;
    const auto colon = cells[1].find(':');
    const std::uint32_t lowest = number(cells[1].substr(colon == std::string::npos ? 0 : colon + 1));
    for (Told& row : found)
      if (row.name == without_ticks(cells[0]))
        row.fields.push_back(
            {without_ticks(cells[2]), cells[3], "", lowest, number(cells[1]) - lowest + 1, {}, {}});
  }
  std::vector<Told> expected = table(true, false, true);
  for (Told& row : expected) {
    if (row.fields[0].width == 32) row.fields.clear();
    for (Told& field : row.fields) field.access.clear();
  }
  EXPECT_EQ(found, expected);
}

// ---- the program ----

TEST(PrintRegisters, RefusesWhatIsNoFormatInALine) {
  Surroundings world;
  world.program = std::string(HOPMESH_BINARY_DIR) + "/print_registers";
  const Finished none = run_program({}, world), other = run_program({"vhdl"}, world);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err,
            "print_registers: found no format, expected markdown, c, systemrdl, ip-xact, svd, verilog\n");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(other.err,
            "print_registers: found \"vhdl\", expected markdown, c, systemrdl, ip-xact, svd, verilog\n");
  EXPECT_EQ(run_program({"svd"}, world).out, file_text("svd"));
  EXPECT_EQ(run_shell(world.program + " svd > /dev/full").exit_code, 2);
}

} // namespace
} // namespace hopmesh::tests
