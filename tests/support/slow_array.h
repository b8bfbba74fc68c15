// The whole array as a plain loop over phases, written from docs/hardware/datapath.md and
// docs/hardware/cycles.md alone.
#pragma once

#include "rtl_model/spec/schedule.h"
#include "sim/cosim/array_job.h"

namespace hopmesh::tests {

using cosim::ArrayJob;

struct ArrayResult {
  std::vector<std::vector<std::int32_t>>
      history; ///< V after every sweep; only the last unless all were asked for
  std::uint32_t sweeps = 0;
  bool converged = false;
  std::uint32_t largest_change = 0; ///< of the last sweep
  std::uint64_t largest_sum = 0;    ///< of the last sweep; 0 where nobody stops by it
  std::uint64_t cycles = 0;

  const std::vector<std::int32_t>& output() const { return history.back(); }
};

enum class Keep { last_sweep, every_sweep };

ArrayResult run_slow_array(const ArrayJob& job, Keep keep = Keep::last_sweep);

/// Cycles from START taken to DONE, by the table of docs/hardware/cycles.md.
std::uint64_t slow_cycles(const ArrayJob& job, std::uint32_t sweeps);

} // namespace hopmesh::tests
