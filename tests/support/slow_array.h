// The whole array as a plain loop over phases, written from docs/datapath.md and docs/cycles.md alone.
#pragma once

#include "rtl_model/spec/schedule.h"

namespace hopmesh::tests {

/// A run: what is built, what the host writes. Codes are words on the bus: weights in Topology's layout.
struct ArrayJob {
  spec::ArraySpec array;
  spec::Topology topology;
  std::vector<std::int32_t> weight, bias, start;
  std::uint32_t threshold = 0, max_sweeps = 1;
};

struct ArrayResult {
  std::vector<std::vector<std::int32_t>>
      history; ///< V after every sweep; only the last unless all were asked for
  std::uint32_t sweeps = 0;
  bool converged = false;
  std::uint32_t largest_change = 0; ///< of the last sweep
  std::uint64_t cycles = 0;

  const std::vector<std::int32_t>& output() const { return history.back(); }
};

enum class Keep { last_sweep, every_sweep };

ArrayResult run_slow_array(const ArrayJob& job, Keep keep = Keep::last_sweep);

/// Cycles from START taken to DONE, by the table of docs/cycles.md.
std::uint64_t slow_cycles(const ArrayJob& job, std::uint32_t sweeps);

} // namespace hopmesh::tests
