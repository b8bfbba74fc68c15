// Instructions that a core has done, by function of its program.
#pragma once

#include "sim/levels/hosts/core_program.h"
#include "sim/levels/hosts/step_host.h"

namespace hopmesh::levels {

class InstructionCounts {
 public:
  explicit InstructionCounts(const CoreProgram& program);

  /// A block of instructions that follow each other, from `address` on.
  void add(std::uint32_t address, std::uint32_t bytes) {
    const std::uint32_t place = (address - begin_) / instruction_bytes, count = bytes / instruction_bytes;
    if (address < library_) caller_ = place;
    own_[place] += count;
    charged_[caller_] += count;
    all_ += count;
  }
  std::uint64_t all() const { return all_; }
  std::vector<HostFunction> functions() const;

 private:
  static constexpr std::uint32_t instruction_bytes = 4; ///< the programs have no compressed ones

  const CoreProgram& program_;
  const std::uint32_t begin_, library_;
  std::uint32_t caller_ = 0; ///< the last block that was the firmware's own
  std::uint64_t all_ = 0;
  std::vector<std::uint64_t> own_, charged_; ///< by place of a block's first instruction
};

} // namespace hopmesh::levels
