// What an array's work comes to in multiplications, whoever counts sweeps.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::levels {

/// Of a sweep: one an input; one for R u, or for m by the change (none where a step is only added, nor for a
/// sign); one by the reciprocal where there is one.
inline std::uint64_t multiplies_a_sweep(const spec::ArraySpec& array, const spec::Topology& t) {
  const bool of_output = array.output == spec::Output::modified || spec::has_momentum(array);
  const std::uint64_t more = static_cast<std::uint64_t>(of_output) + spec::has_reciprocal(array);
  std::uint64_t count = 0;
  for (std::size_t c = 0; c < t.cells(); ++c) count += t.neurons_per_cell * (t.taps(c) + more);
  return count;
}

} // namespace hopmesh::levels
