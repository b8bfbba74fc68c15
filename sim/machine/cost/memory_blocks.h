// Memories of an array as its Verilog has them, and the blocks of an FPGA that they take.
#pragma once

#include "sim/machine/cost/part_features.h"

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::machine {

/// So many memories alike.
struct MemoryShape {
  const char* what;
  double count = 1;
  std::uint64_t width = 0, depth = 0;
  bool read_only = false;

  double bits() const { return count * static_cast<double>(width * depth); }
};

std::vector<MemoryShape> memories_of(const spec::ArraySpec& array, const spec::Topology& topology);

struct MemoryBlocks {
  double ecp5_blocks = 0;  ///< DP16KD: 18 kbit
  double ice40_blocks = 0; ///< SB_RAM40_4K: 4 kbit
  double bits = 0;         ///< that are kept and may change
  double table_bits = 0;   ///< of tables that never change
};
/// By formula: each memory in the shape that takes the fewest blocks.
MemoryBlocks memory_blocks(const std::vector<MemoryShape>& memories);

} // namespace hopmesh::machine
