// Vectors that begin on a cache line, and on a huge page where they are large: a wide load that straddles two
// lines costs twice.
#pragma once

#include <cstdlib>
#include <new>
#include <sys/mman.h>
#include <vector>

namespace hopmesh::engine {

template <typename T> struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <typename Other> AlignedAllocator(const AlignedAllocator<Other>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t line = 64, huge = std::size_t{2} << 20;
    const std::size_t unit = count * sizeof(T) >= 2 * huge ? huge : line;
    const std::size_t bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* at = std::aligned_alloc(unit, bytes);
    if (!at) throw std::bad_alloc();
    if (unit == huge) madvise(at, bytes, MADV_HUGEPAGE); // only a request: nothing depends on it
    return static_cast<T*>(at);
  }
  void deallocate(T* at, std::size_t) { std::free(at); }
  bool operator==(const AlignedAllocator&) const { return true; }
  bool operator!=(const AlignedAllocator&) const { return false; }
};

template <typename T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

} // namespace hopmesh::engine
