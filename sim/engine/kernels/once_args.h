// Weights kept once: what kernels for them are told. The block of weights between two cells of a mesh is
// symmetric, and equal in both directions; so is a cell's own block. Where that is so to the bit, six codes
// of a link do for both of its ends, instead of eighteen.
#pragma once

#include "sim/engine/lane_extremes.h"

#include <cstddef>

namespace hopmesh::engine {

/// Two ways to neighbours, in slots, that share planes of weights: for each pair p <= q of components a plane
/// of words by slot, W[p][q] toward slot + way[0] below, toward slot + way[1] above. So a cell finds its
/// weights from slot - way there.
struct OncePair {
  std::ptrdiff_t planes; ///< the first of its planes, in words from the cells' own
  std::ptrdiff_t way[2]; ///< below zero in a list's backward part
};
/// What cells of a block are linked with: pairs [first, middle) forward, [middle, last) backward.
struct OnceList {
  std::uint32_t first, middle, last;
};
/// Where taps of a block stand among the weights of fast_layout.h, in codes from the row's first, for each
/// pair of its list; `nowhere` where no lane has one.
struct OnceTaps {
  static constexpr std::uint32_t nowhere = UINT32_MAX;
  std::uint32_t at[2][3];
};

struct OnceArgs {
  const std::uint32_t* list_of_block;
  const OnceList* lists;
  const OncePair* pairs;
  const std::uint32_t* weight; ///< the first planes are the cells' own, in the lower half
  std::size_t stride;          ///< from plane to plane
  /// Planes by component; a link stands in both halves of its word.
  const std::uint32_t* link;
  std::uint32_t* next_link;
  std::size_t link_stride;
  const std::int32_t* bias;       ///< at the point of s
  const std::int32_t* multiplier; ///< u is s times it, 32 places lower
  std::int64_t half;              ///< what rounds u there
};

/// What turns weights of all directions into planes; of a block.
struct OnceSource {
  const OnceTaps* taps; ///< of each pair of the block's list
  const std::uint32_t* own_taps;
  const std::uint32_t* weight; ///< of the block
  std::uint32_t* planes;       ///< of OnceArgs, to be written
};

} // namespace hopmesh::engine
