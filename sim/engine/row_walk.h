// The weight memory as the bus sees it: row after row, in the order of spec::Topology.
#pragma once

#include "rtl_model/spec/topology.h"

#include <algorithm>

namespace hopmesh::engine {

/// Calls visit(cell, p, first tap, words) for each piece of a row in [first, first + count).
template <typename Visit>
void walk_rows(const spec::Topology& topology, std::size_t first, std::size_t count, Visit visit) {
  if (count == 0) return;
  const auto per_cell = static_cast<std::size_t>(topology.neurons_per_cell);
  std::size_t cell = 0, high = topology.cells(); // the last cell whose rows begin at or before `first`
  while (high - cell > 1) {
    const std::size_t middle = (cell + high) / 2;
    (topology.row_offset(middle, 0) <= first ? cell : high) = middle;
  }
  const std::size_t within = first - topology.row_offset(cell, 0);
  std::size_t taps = topology.taps(cell), p = within / taps, tap = within % taps;
  while (count > 0) {
    const std::size_t piece = std::min(count, taps - tap);
    visit(cell, p, tap, piece);
    count -= piece;
    tap = 0;
    if (++p < per_cell || count == 0) continue;
    p = 0;
    taps = topology.taps(++cell);
  }
}

} // namespace hopmesh::engine
