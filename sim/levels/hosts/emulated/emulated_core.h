// A core with its memory, emulated by Unicorn: the array stands behind a bridge in its address space.
#pragma once

#include "firmware/host_bus.h"
#include "firmware/riscv/core_map.h"
#include "sim/levels/hosts/emulated/instruction_counts.h"

#include <cstring>
#include <exception>
#include <memory>

struct uc_struct;

namespace hopmesh::levels {

class EmulatedCore {
 public:
  /// Bus and program must outlive it. Throws std::runtime_error where the emulator does not start.
  EmulatedCore(const CoreProgram& program, HostBus& bus);
  ~EmulatedCore();
  EmulatedCore(const EmulatedCore&) = delete;
  EmulatedCore& operator=(const EmulatedCore&) = delete;

  /// Room for so many bytes behind program and earlier rooms: the core's address. Throws std::bad_alloc.
  std::uint32_t reserve(std::size_t bytes);
  /// The core's memory as this processor sees it; both are little-endian.
  template <typename T> T* at(std::uint32_t address) {
    return reinterpret_cast<T*>(ram_.get() + (address - HM_CORE_RAM));
  }
  std::uint64_t memory_bytes() const { return end_ - HM_CORE_RAM; }

  /// Runs a function until it comes back: what it answers. An exception of the bus comes out of it.
  int call(const std::string& function, std::uint32_t argument);

  const InstructionCounts& counts() const { return counts_; }

 private:
  struct Unmap {
    void operator()(std::uint8_t* memory) const;
  };

  void expect(int error, const char* what) const;
  void add_bus();
  std::uint64_t read_array(std::uint32_t address);
  void write_array(std::uint32_t address, std::uint32_t word);
  std::uint64_t read_bridge(std::uint32_t offset);
  void write_bridge(std::uint32_t offset, std::uint32_t word);
  template <typename Use> int guarded(Use use);
  bool in_memory(std::uint32_t address, std::uint32_t words) const;

  const CoreProgram& program_;
  HostBus& bus_;
  std::unique_ptr<std::uint8_t, Unmap> ram_;
  uc_struct* uc_ = nullptr;
  InstructionCounts counts_;
  std::uint32_t end_, stack_ = 0;
  std::uint32_t transfer_address_ = 0, transfer_memory_ = 0;
  int error_ = HM_OK; ///< the first since the core looked
  std::exception_ptr thrown_;
};

} // namespace hopmesh::levels
