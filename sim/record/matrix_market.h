// Matrix Market files: a sparse matrix or a dense vector of doubles that reads back to the same bits.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace hopmesh::record {

struct MatrixEntry {
  std::size_t row, column; ///< 0-based; the file counts from 1
  double value;
};

/// `%%MatrixMarket matrix coordinate real general`, 17 digits.
void write_matrix(const std::filesystem::path& path, std::size_t rows, std::size_t columns,
                  const std::vector<MatrixEntry>& entries);
/// `%%MatrixMarket matrix array real general`, one column, 17 digits.
void write_vector(const std::filesystem::path& path, const std::vector<double>& values);

} // namespace hopmesh::record
