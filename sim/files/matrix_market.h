// Matrix Market files: a sparse matrix or a dense vector of doubles that reads back to the same bits, and
// what other programs write of the kind.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hopmesh::files {

struct MatrixEntry {
  std::size_t row, column; ///< 0-based; the file counts from 1
  double value;
};

/// `%%MatrixMarket matrix coordinate real general`, 17 digits.
void write_matrix(const std::filesystem::path& path, std::size_t rows, std::size_t columns,
                  const std::vector<MatrixEntry>& entries);
/// `%%MatrixMarket matrix array real general`, one column, 17 digits.
void write_vector(const std::filesystem::path& path, const std::vector<double>& values);

struct SparseMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<MatrixEntry> entries; ///< row by row, columns ascending; no place twice
};

/// `coordinate` (real, integer, pattern; a pattern's values are 1) or `array` (real, integer), `general`,
/// `symmetric` or `skew-symmetric`; both halves of the last two are given. Zeros of an `array` are no
/// entries. A banner may begin with one % alone, and a number be written as in Fortran (1.5D-3). Throws
/// input::InputError for everything else, with the line, and for values that are not finite.
SparseMatrix read_matrix(const std::string& path);

/// How many rows a vector must have, and whose number that is: "as W has".
struct RowsWanted {
  std::size_t rows;
  const char* why;
};
/// A matrix of one column, as a dense vector.
std::vector<double> read_vector(const std::string& path, std::optional<RowsWanted> wanted = std::nullopt);

} // namespace hopmesh::files
