// Tables for spreadsheets and scripts: every number in the fewest digits that read back to the same bits.
#pragma once

#include "sim/files/output_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hopmesh::files {

/// Says that each row of a table ends in a cell that proves it, in a column of its own.
struct CheckedRows {};

/// A header, then rows of as many cells: file.cell(step).cell(time).end_row(). Lines end in \n (RFC 4180
/// quoting).
class CsvWriter {
 public:
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& header);
  /// With a column "check" at the end, which end_row() fills in; csv_table.h reads such a table.
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& header, CheckedRows);
  /// Goes on with the file of a stopped run, behind its rows.
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& header, StreamRest rest)
      : file_(path, std::move(rest)), columns_(header.size()) {}

  CsvWriter& cell(double value);
  CsvWriter& cell(std::string_view text);
  CsvWriter& cell(const char* text) { return cell(std::string_view(text)); }
  /// Empty where there is no value.
  CsvWriter& cell(const std::optional<double>& value) { return value ? cell(*value) : cell(""); }
  CsvWriter& cell(bool value) { return raw(value ? "1" : "0"); }
  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  CsvWriter& cell(Integer value) {
    return raw(std::to_string(value));
  }
  void end_row(); ///< throws std::logic_error if the row has more or fewer cells than the header
  void row(const std::vector<double>& values);
  StreamMark sync() { return file_.sync(); }
  void commit() { file_.commit(); }

 private:
  CsvWriter& raw(std::string_view text);

  OutputFile file_;
  std::size_t columns_, filled_ = 0;
  bool checked_ = false;
  std::string line_;
};

/// What proves a row of CheckedRows: 16 hexadecimal digits (XXH64) of its text before that cell.
std::string check_of_row(std::string_view text);

/// The fewest digits that read back as the same double: 0.1, 1e-300, inf, nan.
std::string shortest(double value);

} // namespace hopmesh::files
