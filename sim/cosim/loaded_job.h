// A job in an array's memories: put there, and read back.
#pragma once

#include "sim/cosim/array_job.h"
#include "sim/levels/bus_array.h"

namespace hopmesh::cosim {

using levels::BusArray;
using levels::Codes;

/// Weights, biases and start.
inline void load(const BusArray& array, const ArrayJob& job) {
  array.load(job.weight, job.bias, job.start);
}

/// What stands in an array's memories and registers now, as a job that starts from `start`.
ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start);

} // namespace hopmesh::cosim
