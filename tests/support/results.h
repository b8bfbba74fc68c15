// Reads what the program writes, with code of its own: NumPy arrays, tables, JSON, Matrix Market, results
// folders.
#pragma once

#include "tests/support/files.h"

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

namespace hopmesh::tests {

/// A .npy file: dtype as NumPy writes it ("<f8"), shape, values as double (exact for int32). Throws
/// std::runtime_error for a file that is none, or whose size is not what its header says.
struct Array {
  std::string dtype;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};
Array read_array(const std::filesystem::path& path);

/// A table by columns; `header` keeps their order.
struct Table {
  std::vector<std::string> header;
  std::map<std::string, std::vector<std::string>> column;

  std::size_t rows() const { return column.at(header[0]).size(); }
  std::vector<double> numbers(const std::string& name) const;
};
Table read_table(const std::filesystem::path& path);

nlohmann::json read_json(const std::filesystem::path& path);

/// Matrix Market, coordinate or array: dense [rows][columns], with the header line as written.
struct Market {
  std::string header;
  std::size_t rows = 0, columns = 0, entries = 0;
  std::vector<std::vector<double>> values;
};
Market read_market(const std::filesystem::path& path);

/// Is this a results folder of so many steps with every file whole? "" or what is wrong.
std::string fault_of_results(const std::filesystem::path& folder, std::size_t steps, bool fixed = true);

} // namespace hopmesh::tests
