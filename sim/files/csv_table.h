// A table read back: what CsvWriter writes, as texts and numbers by column name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hopmesh::files {

struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows; ///< each as long as the header

  std::optional<std::size_t> column(std::string_view name) const;
  /// "" where there is no such column.
  const std::string& text(std::size_t row, std::string_view name) const;
  /// None where the cell is empty or no finite number.
  std::optional<double> number(std::size_t row, std::string_view name) const;
};

/// Throws input::InputError where a row is no row.
CsvTable parse_csv(std::string_view text, const std::string& path);
/// A table that CsvWriter wrote with CheckedRows under these columns, without its checks. Throws
/// input::InputError with the line of whatever is not as it was written.
CsvTable parse_checked_csv(std::string_view text, const std::string& path,
                           const std::vector<std::string>& columns);
CsvTable read_csv(const std::filesystem::path& path);

} // namespace hopmesh::files
