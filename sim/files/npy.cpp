// Version 1.0 of the format: magic, header length, a Python dictionary padded with spaces, then the values.
#include "sim/files/npy.h"

#include "sim/input/line_reader.h"
#include "sim/input/number.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>

namespace hopmesh::files {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "values are written as they lie in memory");

// Room for any row count: the header keeps its size when the count is known, and the values stay 64-byte
// aligned.
constexpr std::size_t header_bytes = 128;
constexpr std::size_t prefix_bytes = 10;

template <class T> constexpr const char* descriptor() {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int32_t>);
  return std::is_same_v<T, double> ? "<f8" : "<i4";
}

template <class T> std::string header(std::size_t rows, const std::vector<std::size_t>& row_shape) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}",
                                 descriptor<T>(), rows, fmt::join(row_shape, ", "));
  text.resize(header_bytes - prefix_bytes - 1, ' ');
  const char length = static_cast<char>(header_bytes - prefix_bytes);
  return std::string("\x93NUMPY\x01\x00", 8) + length + '\0' + text + '\n';
}

/// What stands behind 'key': in the header's dictionary, up to the end of the line.
std::string value_of(const std::string& dictionary, const char* key) {
  const auto at = dictionary.find(key);
  if (at == std::string::npos) return {};
  const auto begin = dictionary.find_first_not_of(' ', dictionary.find(':', at) + 1);
  return begin == std::string::npos ? std::string{} : dictionary.substr(begin);
}

/// "(3, 4)" or "(5,)"; none where that is no list of sizes.
std::optional<std::vector<std::size_t>> parse_shape(const std::string& text) {
  std::vector<std::size_t> shape;
  const std::size_t end = text.find(')');
  if (text.empty() || text[0] != '(' || end == std::string::npos) return std::nullopt;
  for (std::size_t at = 1, comma; at < end; at = comma + 1) {
    comma = std::min(text.find(',', at), end);
    const std::string_view size = input::Words(std::string_view(text).substr(at, comma - at)).next();
    if (!size.empty() && !input::parse_number(size, shape.emplace_back())) return std::nullopt;
  }
  return shape;
}

std::size_t product(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// Do so many values of these sizes stand in `bytes`? None of the sizes is believed before.
bool fits(const std::vector<std::size_t>& shape, std::uint64_t value_bytes, std::uint64_t bytes) {
  if (!shape.empty() && shape[0] == 0) return true;
  std::uint64_t needed = value_bytes;
  for (const std::size_t size : shape) // rows without values count as if they had one
    if (__builtin_mul_overflow(needed, std::max<std::uint64_t>(size, 1), &needed)) return false;
  return needed <= bytes;
}

} // namespace

template <class T>
NpyWriter<T>::NpyWriter(const std::filesystem::path& path, const std::vector<std::size_t>& row_shape)
    : file_(path), row_shape_(row_shape), row_size_(product(row_shape)) {
  file_.write(head(row_shape));
}

template <class T>
NpyWriter<T>::NpyWriter(const std::filesystem::path& path, const std::vector<std::size_t>& row_shape,
                        StreamRest rest)
    : file_(path, std::move(rest)), row_shape_(row_shape), row_size_(product(row_shape)) {
  rows_ = (file_.bytes() - header_bytes) / (row_size_ * sizeof(T));
}

template <class T> std::string NpyWriter<T>::head(const std::vector<std::size_t>& row_shape) {
  return header<T>(0, row_shape);
}

template <class T> void NpyWriter<T>::append(const T* row) {
  file_.write(row, row_size_ * sizeof(T));
  ++rows_;
}

template <class T> void NpyWriter<T>::append(const std::vector<T>& row) {
  if (row.size() != row_size_)
    throw WriteError(
        fmt::format("{}: a row of {} values where {} belong", file_.path().string(), row.size(), row_size_));
  append(row.data());
}

template <class T> void NpyWriter<T>::commit() {
  file_.patch(0, header<T>(rows_, row_shape_));
  file_.commit();
}

template <class T>
NpyReader<T>::NpyReader(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
  const auto refuse = [&](const std::string& why) {
    throw ReadError(fmt::format("{}: {}", path.string(), why));
  };
  if (!file_) refuse("cannot be opened");
  char prefix[prefix_bytes] = {};
  file_.read(prefix, sizeof prefix);
  if (!file_ || std::string(prefix, 6) != "\x93NUMPY" || prefix[6] != 1) refuse("not a NumPy 1.0 array file");
  const std::size_t length =
      static_cast<unsigned char>(prefix[8]) + 256u * static_cast<unsigned char>(prefix[9]);
  std::string dictionary(length, ' ');
  file_.read(dictionary.data(), static_cast<std::streamsize>(length));
  if (!file_) refuse("the header is cut short");
  const std::string type = value_of(dictionary, "'descr'").substr(0, 5);
  if (type != fmt::format("'{}'", descriptor<T>()))
    refuse(fmt::format("values of type {}, expected '{}'", type, descriptor<T>()));
  if (value_of(dictionary, "'fortran_order'").rfind("False", 0) != 0) refuse("Fortran order is not read");
  const auto shape = parse_shape(value_of(dictionary, "'shape'"));
  if (!shape) refuse("a shape that is no list of sizes");
  shape_ = *shape;
  data_offset_ = prefix_bytes + length; // so much was read just now
  const std::uint64_t left = std::filesystem::file_size(path) - data_offset_;
  if (!fits(shape_, sizeof(T), left)) refuse("shorter than its header says");
  for (std::size_t d = 1; d < shape_.size(); ++d) row_size_ *= shape_[d];
}

template <class T> std::vector<T> NpyReader<T>::row(std::size_t index) {
  if (index >= rows())
    throw ReadError(fmt::format("{}: row {} of {} asked for", path_.string(), index, rows()));
  std::vector<T> values(row_size_);
  file_.seekg(static_cast<std::streamoff>(data_offset_ + index * row_size_ * sizeof(T)));
  file_.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(row_size_ * sizeof(T)));
  if (!file_) throw ReadError(fmt::format("{}: row {} cannot be read", path_.string(), index));
  return values;
}

template <class T> NpyArray<T> read_npy(const std::filesystem::path& path) {
  NpyReader<T> reader(path);
  NpyArray<T> array{reader.shape(), {}};
  array.values.reserve(reader.rows() * reader.row_size());
  for (std::size_t r = 0; r < reader.rows(); ++r) {
    const auto row = reader.row(r);
    array.values.insert(array.values.end(), row.begin(), row.end());
  }
  return array;
}

template class NpyWriter<double>;
template class NpyWriter<std::int32_t>;
template class NpyReader<double>;
template class NpyReader<std::int32_t>;
template NpyArray<double> read_npy<double>(const std::filesystem::path&);
template NpyArray<std::int32_t> read_npy<std::int32_t>(const std::filesystem::path&);

} // namespace hopmesh::files
