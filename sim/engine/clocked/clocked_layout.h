// Where the clock-stepped engine keeps each neuron: those that fire in one phase lie side by side, longest
// rows first, so that every beat of the phase works on a stretch of places.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "sim/engine/generic/lane_arithmetic.h"

namespace hopmesh::engine {

/// Neighbours of places side by side whose rows lie side by side too: places [place, place + count) read rows
/// row + p * width, ... of their neighbour's neuron p.
struct LinkRun {
  std::uint32_t place, count, row, width;
};

/// What one beat of a bank's phase does: adds a group of taps to the first `rows` places, and works on the
/// stretches [first, last) of those that are normalised, and pulled to their bound.
struct ClockedBeat {
  std::uint32_t rows, first_normalised, last_normalised, first_pulled, last_pulled;
};

/// The cells of a colour, one cell (sequential), or all cells (synchronous): those whose neurons fire in the
/// same phases. Place k of a bank holds a cell; its neuron p has row first_row + p * width + k.
struct ClockedBank {
  std::size_t width = 0; ///< places; some at the end of a stretch of equal rows may be empty
  std::size_t taps = 0;  ///< of its longest row
  std::size_t first_row = 0;
  std::size_t first_weight = 0; ///< of [p][tap][place]
  /// reach[b]: places whose rows have more than b beats. Rows of exactly b beats: [reach[b], reach[b - 1]).
  std::vector<std::size_t> reach;
  std::vector<ClockedBeat> beat; ///< of each clock of its phases
  /// For the k-th neighbour of every place. A place with fewer neighbours reads its own rows, with weight
  /// zero.
  std::vector<std::vector<LinkRun>> runs;

  std::size_t beats() const { return reach.size() - 1; }
  /// From the inputs of a tap to those of the next; leaves room for the lanes that copy_runs writes beyond a
  /// run.
  std::size_t input_stride() const { return width + lane_count; }
  /// Places whose rows have from `least` to `most` beats, as a stretch [first, last).
  std::pair<std::size_t, std::size_t> with_beats(std::int64_t least, std::int64_t most) const {
    least = least < 1 ? 1 : least;
    most = most > static_cast<std::int64_t>(beats()) ? static_cast<std::int64_t>(beats()) : most;
    if (least > most) return {0, 0};
    return {reach[static_cast<std::size_t>(most)], reach[static_cast<std::size_t>(least) - 1]};
  }
  /// Places whose sums were complete `cycles` cycles before one of the clocks [first, last) of the phase
  /// ends.
  std::pair<std::size_t, std::size_t> with_beats_over(std::uint64_t first, std::uint64_t last,
                                                      std::uint64_t cycles) const {
    const auto least = static_cast<std::int64_t>(first) - static_cast<std::int64_t>(cycles) + 1;
    return with_beats(least, least + static_cast<std::int64_t>(last - first) - 1);
  }
};

struct ClockedLayout {
  ClockedLayout(const spec::ArraySpec& array, const spec::Topology& topology, const spec::Phases& phases);

  std::size_t rows = 0, weights = 0;
  std::size_t inputs = 0; ///< codes that the bank with most inputs reads
  std::vector<ClockedBank> banks;
  std::vector<std::uint32_t> bank_of_cell, place_of_cell;

  std::size_t row(std::size_t cell, std::size_t p) const {
    const ClockedBank& bank = banks[bank_of_cell[cell]];
    return bank.first_row + p * bank.width + place_of_cell[cell];
  }
  std::size_t weight(std::size_t cell, std::size_t p, std::size_t tap) const {
    const ClockedBank& bank = banks[bank_of_cell[cell]];
    return bank.first_weight + (p * bank.taps + tap) * bank.width + place_of_cell[cell];
  }

 private:
  /// `unit`: places are handed out in multiples of it.
  void place(std::vector<std::uint32_t> cells, const spec::ArraySpec& array, const spec::Topology& topology,
             std::size_t unit);
  void find_runs(const std::vector<std::vector<std::uint32_t>>& cells, const spec::Topology& topology);
};

} // namespace hopmesh::engine
