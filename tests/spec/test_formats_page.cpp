// docs/hardware/number-formats.md says what the oracle does: its tables are read, its pictures are drawn anew
// and compared.
#include "tests/support/files.h"
#include "tests/support/slow_fixed.h"
#include "tests/support/staircase.h"

#include "place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace hopmesh::tests {
namespace {

using spec::NumberFormat;
using spec::Overflow;
using spec::Rounding;

const std::string docs = std::string(HOPMESH_SOURCE_DIR) + "/docs/";

/// The page writes the minus sign as it should be; strtod wants a hyphen.
std::string plain(std::string cell) {
  const std::string minus = "−";
  for (std::size_t at; (at = cell.find(minus)) != std::string::npos;) cell.replace(at, minus.size(), "-");
  const std::size_t first = cell.find_first_not_of(" `"), last = cell.find_last_not_of(" `");
  return first == std::string::npos ? "" : cell.substr(first, last - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (const std::string& part : split(line, '|')) cells.push_back(plain(part));
  if (cells.size() < 3) return {};
  return {cells.begin() + 1, cells.end() - 1};
}

/// Rows of numbers of the table whose header begins with `corner`; the header first.
std::vector<std::vector<std::string>> table(const std::string& corner) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of(content_of(docs + "hardware/number-formats.md"))) {
    const auto cells = cells_of(line);
    if (rows.empty() ? !cells.empty() && cells[0] == corner : !cells.empty()) rows.push_back(cells);
    if (!rows.empty() && cells.empty()) break;
  }
  if (rows.size() > 1) rows.erase(rows.begin() + 1); // the dashes
  return rows;
}

TEST(FormatsPage, RoundingTable) {
  const auto rows = table("value");
  ASSERT_EQ(rows.size(), 16u);
  for (std::size_t r = 1; r < rows.size(); ++r)
    for (std::size_t q = 0; q < spec::rounding_names.size(); ++q) {
      EXPECT_EQ(rows[0][q + 1], spec::rounding_names[q]);
      const NumberFormat f{8, 8, static_cast<Rounding>(q), Overflow::sat};
      EXPECT_EQ(std::stoi(rows[r][q + 1]), quantise_double(std::stod(rows[r][0]), 0, f))
          << rows[r][0] << f.text();
    }
}

TEST(FormatsPage, OverflowTable) {
  const auto rows = table("number");
  ASSERT_EQ(rows.size(), 10u);
  for (std::size_t r = 1; r < rows.size(); ++r)
    for (std::size_t o = 0; o < spec::overflow_names.size(); ++o) {
      EXPECT_EQ(rows[0][o + 1], spec::overflow_names[o]);
      const NumberFormat f{4, 4, Rounding::trn, static_cast<Overflow>(o)};
      EXPECT_EQ(std::stoi(rows[r][o + 1]), quantise_code(std::stoi(rows[r][0]), 0, f))
          << rows[r][0] << f.text();
    }
}

/// Compares a picture with the tree's; with HOPMESH_DRAW set, writes it instead.
void expect_picture(const std::string& kind, std::string_view mode, const std::string& drawn) {
  std::string name(mode);
  for (char& c : name) c = static_cast<char>(std::tolower(c));
  const std::string path = docs + "pictures/" + kind + "-" + name + ".svg";
  if (std::getenv("HOPMESH_DRAW")) write_text(path, drawn);
  EXPECT_EQ(content_of(path), drawn) << path;
}

TEST(FormatsPage, RoundingPictures) {
  for (std::size_t q = 0; q < spec::rounding_names.size(); ++q) {
    const NumberFormat f{8, 8, static_cast<Rounding>(q), Overflow::sat};
    expect_picture("rounding", spec::rounding_names[q],
                   draw_staircase(std::string(spec::rounding_names[q]), 3,
                                  [&](int quarters) { return quantise_code(quarters, 2, f); }));
  }
}

TEST(FormatsPage, OverflowPictures) {
  for (std::size_t o = 0; o < spec::overflow_names.size(); ++o) {
    const NumberFormat f{4, 4, Rounding::trn, static_cast<Overflow>(o)};
    expect_picture("overflow", spec::overflow_names[o],
                   draw_dots(std::string(spec::overflow_names[o]), 20, 10,
                             [&](int x) { return quantise_code(x, 0, f); }));
  }
}

} // namespace
} // namespace hopmesh::tests
