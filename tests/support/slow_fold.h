// Cycles of folded arrays by stepping through them, written from docs/hardware/cycles.md alone.
#pragma once

#include "rtl_model/spec/schedule.h"
#include "sim/cosim/array_job.h"

namespace hopmesh::tests {

/// What the page calls S: cycles from a sum to its V.
std::uint64_t slow_stage(const spec::ArraySpec& array);

/// When neurons of a folded array write V.
struct SlowSweep {
  /// Of each neuron: cycles of the sweep that have passed when its V shows.
  std::vector<std::uint64_t> written;
  std::vector<std::uint64_t> phases; ///< cycles of each
};
SlowSweep slow_folded_sweep(const cosim::ArrayJob& job);
std::uint64_t slow_folded_prepare(const cosim::ArrayJob& job);

} // namespace hopmesh::tests
