// Bytes as text (RFC 4648), on their way into a file: nothing of them is held but a few kilobytes.
#pragma once

#include "sim/files/output_file.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace hopmesh::files {

class Base64Writer {
 public:
  explicit Base64Writer(OutputFile& file) : file_(file) {}
  Base64Writer(const Base64Writer&) = delete;
  Base64Writer& operator=(const Base64Writer&) = delete;

  void bytes(const void* data, std::size_t count);
  /// A value as it lies in memory.
  template <class T> void value(const T& value) {
    if (waiting_ + sizeof value > block_.size()) return bytes(&value, sizeof value);
    std::memcpy(block_.data() + waiting_, &value, sizeof value);
    waiting_ += sizeof value;
  }
  template <class T> void values(const std::vector<T>& values) {
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// The last digits; nothing may follow.
  void end();

 private:
  void flush();

  OutputFile& file_;
  std::array<unsigned char, 3 * 1024> block_; ///< whole groups of three: no padding before the end
  std::size_t waiting_ = 0;
};

} // namespace hopmesh::files
