// NumPy's array file, row by row: a run of any length is written, and read back, without being held in
// memory.
#pragma once

#include "sim/files/output_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace hopmesh::files {

/// An array of shape [rows, row_shape...] with T = double (float64) or std::int32_t (int32), little endian, C
/// order. The number of rows is filled in by commit(), so a run that was stopped early still leaves a right
/// file.
template <class T> class NpyWriter {
 public:
  NpyWriter(const std::filesystem::path& path, const std::vector<std::size_t>& row_shape);
  /// Goes on with the file of a stopped run, behind its rows.
  NpyWriter(const std::filesystem::path& path, const std::vector<std::size_t>& row_shape, StreamRest rest);
  /// The first bytes of a file of such rows until commit() fills in their number.
  static std::string head(const std::vector<std::size_t>& row_shape);
  void append(const T* row); ///< one row
  void append(const std::vector<T>& row);
  StreamMark sync() { return file_.sync(); }
  void commit();
  std::size_t rows() const { return rows_; }

 private:
  OutputFile file_;
  const std::vector<std::size_t> row_shape_;
  std::size_t row_size_, rows_ = 0;
};

extern template class NpyWriter<double>;
extern template class NpyWriter<std::int32_t>;

/// A file that is no such array: one line with the path and what was found.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An array on disk with any number of dimensions; a row is everything behind the first.
template <class T> class NpyReader {
 public:
  explicit NpyReader(const std::filesystem::path& path);
  const std::vector<std::size_t>& shape() const { return shape_; }
  std::size_t rows() const { return shape_.empty() ? 1 : shape_[0]; }
  std::size_t row_size() const { return row_size_; }
  std::vector<T> row(std::size_t index);

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::size_t> shape_;
  std::size_t row_size_ = 1;
  std::uint64_t data_offset_ = 0;
};

extern template class NpyReader<double>;
extern template class NpyReader<std::int32_t>;

template <class T> struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<T> values;
};

template <class T> NpyArray<T> read_npy(const std::filesystem::path& path);
extern template NpyArray<double> read_npy<double>(const std::filesystem::path&);
extern template NpyArray<std::int32_t> read_npy<std::int32_t>(const std::filesystem::path&);

} // namespace hopmesh::files
