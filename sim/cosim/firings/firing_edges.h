// Edges that a firing may show: the places where cores go wrong.
#pragma once

#include "sim/cosim/firings/firing_columns.h"

namespace hopmesh::cosim {

/// In the order of the table and of the bits in a file.
enum class FiringEdge : std::uint8_t {
  norm_zero,
  sum_zero,
  sum_is_norm,
  state_high,
  state_low,
  sum_tie,
  sum_overflow,
  drive_tie,
  drive_overflow,
  limited,
  change_tie,
  link_tie,
  held,
  ahead_tie,
  ahead_held
};

struct EdgeWords {
  const char* name; ///< in files
  const char* meaning;
};
const std::vector<EdgeWords>& firing_edges();

inline std::uint32_t bit_of(FiringEdge edge) {
  return std::uint32_t{1} << static_cast<unsigned>(edge);
}

/// All edges that a firing shows. Its steps must be filled in.
std::uint32_t edges_of(const Firing& firing, const NeuronShape& shape);
/// "norm_zero+state_high"; "-" for none.
std::string edge_names(std::uint32_t edges);
/// Nothing for a name that no edge has.
std::optional<std::uint32_t> edges_named(const std::string& names);

} // namespace hopmesh::cosim
