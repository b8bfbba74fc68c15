// Every number in a table reads back as the same bits.
#include "sim/files/csv.h"
#include "tests/support/files.h"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>

namespace hopmesh::tests {
namespace {

using namespace files;

TEST(Csv, TableLooksAsExpected) {
  const Folder folder;
  CsvWriter file(folder / "a.csv", {"step", "time", "converged", "note"});
  file.cell(1).cell(0.1).cell(true).cell("plain").end_row();
  file.cell(std::uint64_t{18446744073709551615u}).cell(1e-300).cell(false).cell("a, \"b\"").end_row();
  file.commit();
  EXPECT_EQ(content_of(folder / "a.csv"), "step,time,converged,note\n"
                                          "1,0.1,1,plain\n"
                                          "18446744073709551615,1e-300,0,\"a, \"\"b\"\"\"\n");
}

TEST(Csv, DoublesRoundTrip) {
  using limits = std::numeric_limits<double>;
  const std::vector<double> row{0.1,
                                -0.0,
                                1.0 / 3.0,
                                6.02214076e23,
                                limits::max(),
                                limits::min(),
                                limits::denorm_min(),
                                -limits::infinity()};
  const Folder folder;
  CsvWriter file(folder / "a.csv", std::vector<std::string>(row.size(), "x"));
  file.row(row);
  file.commit();
  std::istringstream text(content_of(folder / "a.csv"));
  std::string line, cell;
  std::getline(text, line);
  for (const double value : row) {
    std::getline(text, cell, ',');
    const double back = std::strtod(cell.c_str(), nullptr);
    EXPECT_EQ(std::memcmp(&back, &value, sizeof value), 0) << cell;
  }
}

TEST(Csv, RowOfWrongLengthIsAProgrammersError) {
  const Folder folder;
  CsvWriter file(folder / "a.csv", {"a", "b"});
  EXPECT_THROW(file.row({1.0}), std::logic_error);
}

} // namespace
} // namespace hopmesh::tests
