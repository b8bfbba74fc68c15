// A run of an array, whole: what is built, what the host writes. All that two levels have to agree on
// follows from it.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/relaxation.h"
#include "rtl_model/spec/topology.h"

#include <cstdint>
#include <vector>

namespace hopmesh::cosim {

/// Of a rule's share: the largest that STOP has bits for.
inline constexpr int most_share = 63;

inline std::size_t table_entries(const spec::ArraySpec& array) {
  return spec::has_momentum(array) ? static_cast<std::size_t>(array.momentum_entries) : 0;
}

/// Codes are words on the bus: weights in Topology's layout, `max_sweeps` of 0 is taken as 1.
struct ArrayJob {
  spec::ArraySpec array;
  spec::Topology topology;
  std::vector<std::int32_t> weight, bias, start;
  std::uint32_t threshold = 0, max_sweeps = 1;
  spec::StopRule rule = {};                ///< whether `threshold` says when a run ends, and what else does
  std::vector<std::int32_t> momentum = {}; ///< the table of m, every entry; empty where the array has none
};

} // namespace hopmesh::cosim
