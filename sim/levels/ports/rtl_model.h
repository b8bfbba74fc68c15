// A Verilated model of the RTL, loaded from a shared object: hm_device behind the C face of
// rtl_model/verilog/hm_model.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace hopmesh::levels {

/// The functions of a loaded model; they stay loaded until the program ends.
class RtlLibrary {
 public:
  /// Throws std::runtime_error, in one line, for what cannot be loaded.
  explicit RtlLibrary(const std::filesystem::path& file);

  void* (*make)();
  void (*free)(void*);
  int (*table)(void*, int, const std::uint32_t*, std::uint64_t, std::uint64_t);
  void (*facts)(void*, const std::uint32_t*, std::uint64_t);
  int (*transfer)(void*, int, std::uint32_t, std::uint32_t*, std::uint32_t);
  std::uint64_t (*wait)(void*, std::uint64_t);
  int (*irq)(void*);
  int (*busy)(void*);
};

} // namespace hopmesh::levels
