// Bytes as digits in base64 (RFC 4648), on their way into a file: no more than a few kilobytes are held.
#pragma once

#include "sim/files/output_file.h"

#include <vector>

namespace hopmesh::pictures {

class Base64Writer {
 public:
  explicit Base64Writer(files::OutputFile& file) : file_(file) {}

  void bytes(const void* data, std::size_t count);
  /// A value as it lies in memory.
  template <class T> void value(const T& value) { bytes(&value, sizeof value); }
  template <class T> void values(const std::vector<T>& values) {
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// The last digits; nothing may follow.
  void end();

 private:
  files::OutputFile& file_;
  std::string waiting_;
};

} // namespace hopmesh::pictures
