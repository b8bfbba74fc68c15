// What the processor can do at most: reading memory in order, and multiplying 16-bit numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hopmesh::bench {

/// Reads so many bytes from first to last, with the widest loads there are.
class Stream {
 public:
  explicit Stream(std::size_t bytes);
  ~Stream();
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  std::int32_t read() const;
  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_;
  std::int32_t* data_;
};

/// Multiplies and adds in registers for a while; returns how many 16-bit products that were.
double multiply_add_peak();

} // namespace hopmesh::bench
