// A job in an array's memories: put there, run, whole or sweep by sweep, and read back.
#pragma once

#include "sim/cosim/array_job.h"
#include "sim/levels/bus_array.h"

namespace hopmesh::cosim {

using levels::BusArray;
using levels::Codes;

/// Weights, biases, start and table.
inline void load(const BusArray& array, const ArrayJob& job) {
  array.load(job.weight, job.bias, job.start);
  if (!job.momentum.empty()) array.put_momentum(job.momentum);
}

/// From where V is.
inline spec::Relaxation run_whole(const BusArray& array, const ArrayJob& job) {
  return array.run(job.threshold, job.max_sweeps, job.rule);
}

/// A job's run sweep by sweep, on memories as they stand. Each sweep is a run of its own: from where the last
/// one ended, since between two sweeps an array has no state but V; or, with momentum, from the job's start
/// and a sweep longer than the last one.
class SweepBySweep {
 public:
  enum class Each { as_the_array_may, from_the_start };
  SweepBySweep(const BusArray& array, const ArrayJob& job, Each each = Each::as_the_array_may);

  /// The next sweep; what its run came to.
  spec::Relaxation next();

 private:
  const BusArray& array_;
  const ArrayJob& job_;
  const bool from_the_start_;
  std::uint32_t sweeps_ = 0;
};

/// What stands in an array's memories and registers now, as a job that starts from `start`.
ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start);

} // namespace hopmesh::cosim
