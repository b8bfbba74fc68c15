// Where the engine keeps each cell: cells that fire together lie side by side, in blocks of sixteen lanes.
#pragma once

#include "rtl_model/spec/schedule.h"

namespace hopmesh::engine {

inline constexpr std::size_t block_lanes = 16;
inline constexpr std::uint32_t no_cell = UINT32_MAX;

/// Cells of one group share no link and so may be worked on in any order, their neurons one after the other:
/// that leaves the same bits as firing phase by phase.
///   coloured     a group is a colour
///   sequential   a group is a level of the graph whose links point from the lower to the higher number
///   synchronous  one group; links then lead within it, and a sweep reads what was there before it
/// Blocks lie chunk after chunk, and in a chunk group after group. A chunk is a run of cell numbers so long
/// that no link reaches beyond the next chunk: what allows several sweeps to follow each other through the
/// mesh. Within a group of a chunk cells lie by number, or by number of neighbours where that saves much.
struct Layout {
  /// `chunk_cells`: wanted length of a chunk, which long links make longer; 0: one chunk.
  Layout(const spec::Topology& topology, const spec::Phases& phases, spec::Schedule schedule,
         std::size_t chunk_cells = 0);

  /// Whether a link leads from a cell of one group to one of the other in another chunk; chunks > 1.
  bool groups_meet_across_chunks(std::size_t one, std::size_t other) const {
    return across_[one * groups + other];
  }

  std::size_t groups = 0, chunks = 1;
  std::vector<std::uint32_t> slot_of_cell; ///< slot = block * block_lanes + lane
  std::vector<std::uint32_t> cell_of_slot; ///< or no_cell
  std::vector<std::uint32_t>
      first_block; ///< of chunk r and group g: [r * groups + g]; the number of blocks at the end
  std::vector<std::uint32_t> degree; ///< neighbours of a slot's cell
  /// Most neighbours of a cell of the block. Lanes with fewer have their own slot as source there.
  std::vector<std::uint32_t> neighbours;
  std::vector<std::uint32_t> first_source; ///< of each block in `source`; the size of `source` at the end
  std::vector<std::uint32_t> source;       ///< slots: [neighbour][lane] of each block

  std::size_t blocks() const { return neighbours.size(); }
  std::size_t slots() const { return blocks() * block_lanes; }

 private:
  void place(const spec::Topology& topology, const std::vector<std::uint32_t>& group,
             std::size_t chunk_cells);
  void find_sources(const spec::Topology& topology);

  std::vector<bool> across_; ///< [groups][groups]
};

/// For each cell the group in which it fires.
std::vector<std::uint32_t> groups_of_cells(const spec::Topology& topology, const spec::Phases& phases,
                                           spec::Schedule schedule);

/// Largest distance between the numbers of two linked cells.
std::size_t link_reach(const spec::Topology& topology);

} // namespace hopmesh::engine
