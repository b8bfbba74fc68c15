// Several arrays that hold the same network, advanced together, one sweep at a time: equal after each?
#pragma once

#include "sim/cosim/divergence.h"

#include <optional>

namespace hopmesh::cosim {

using Arrays = std::vector<BusArray>;

struct Lockstep {
  std::uint64_t sweeps = 0;        ///< after which all arrays were equal
  std::size_t other = 0;           ///< the array that parted from the first
  std::optional<Divergence> where; ///< none: they never did
  std::vector<Codes> outputs;      ///< of each array, after the last sweep done
};

/// `sweeps` sweeps one by one from the job's start (SweepBySweep), on memories as they stand. The arrays must
/// be idle.
Lockstep run_in_lockstep(const Arrays& arrays, const ArrayJob& job, std::uint32_t sweeps);

/// Where two arrays part whose fault depends on how long a run has lasted: the job from its start,
/// one sweep further each time. Quadratic.
std::optional<Divergence> part_from_start(const Arrays& two, const ArrayJob& job, std::uint32_t sweeps);

/// "WEIGHT word 7: 12 and 13", where the memories of two arrays of a job first differ; "" where they are
/// equal.
std::string memory_difference(const Arrays& two, const ArrayJob& job);

} // namespace hopmesh::cosim
