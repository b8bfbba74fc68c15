// A run of an array, whole: what is built, what the host writes. All that two levels have to agree on
// follows from it.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

#include <cstdint>
#include <vector>

namespace hopmesh::cosim {

/// Codes are words on the bus: weights in Topology's layout, `max_sweeps` of 0 is taken as 1.
struct ArrayJob {
  spec::ArraySpec array;
  spec::Topology topology;
  std::vector<std::int32_t> weight, bias, start;
  std::uint32_t threshold = 0, max_sweeps = 1;
};

} // namespace hopmesh::cosim
