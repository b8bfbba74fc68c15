// Registers of every neuron and what one beat does to them, row by row or in lanes.
#pragma once

#include "sim/engine/aligned.h"
#include "sim/engine/clocked/clocked_layout.h"
#include "sim/engine/generic/drive_path.h"

namespace hopmesh::engine {

/// Memories and registers by row (ClockedLayout), as they stand after a clock.
struct ClockedRegisters {
  AlignedVector<std::int32_t> weight;             ///< ClockedLayout::weight
  AlignedVector<std::int32_t> bias, state, link;  ///< I, V, and V as neighbours see it
  AlignedVector<std::int64_t> norm, reciprocal;   ///< N, r
  AlignedVector<std::int64_t> sum, drive, change; ///< s, u, Delta V
};

class ClockedBeats {
 public:
  ClockedBeats(const Plan& plan, const ClockedLayout& layout);

  ClockedRegisters at;

  /// V from the host, and its links.
  void load(std::size_t cell, std::size_t p, std::int32_t state);

  /// Prepare: N of all rows of a bank, in its beats [first, last).
  void begin_norms(const ClockedBank& bank);
  void add_norms(const ClockedBank& bank, std::uint64_t first, std::uint64_t last);
  void invert(const ClockedBank& bank);

  /// What the rows of a bank read in a phase that fires neurons p ...; `neighbours`: those too, or only the
  /// cells' own.
  void take_links(const ClockedBank& bank, bool neighbours);
  void begin_sums(const ClockedBank& bank, std::size_t p);
  void add_beats(const ClockedBank& bank, std::size_t p, std::uint64_t first, std::uint64_t last);
  /// Rows [first, last).
  void normalise(std::size_t first, std::size_t last);
  void pull_to_bound(std::size_t first, std::size_t last);
  /// Are beats one tap each, which tap_adder() only adds to sums?
  bool plain() const { return plain_sums_ && lanes_ == 1; }
  using TapAdder = void (*)(const std::int32_t* weights, const std::int32_t* inputs, std::size_t rows,
                            std::int64_t* sums);
  TapAdder tap_adder() const;
  const std::int32_t* inputs() const { return in_.data(); }
  /// The largest |Delta V|.
  std::int64_t publish(const ClockedBank& bank, std::size_t p);

 private:
  /// A group of taps: weights, what they weigh, and how far it is from a tap to the next.
  struct Taps {
    const std::int32_t* weights;
    std::size_t weight_stride;
    const std::int32_t* inputs;
    std::size_t input_stride, count;
  };

  /// Rows [row, row + rows) of the taps; `sums` is that of the first.
  void add(const Taps& taps, std::size_t row, std::size_t rows, std::int64_t* sums) const;
  void add_rounded(const Taps& taps, std::size_t rows, std::int64_t* sums) const;
  std::int64_t rounded_sum(std::int64_t sum, std::int64_t products) const;

  const Plan& plan_;
  const ClockedLayout& layout_;
  const DrivePath path_;
  const LaneRounding to_state_, to_link_;
  LaneRounding to_sum_;
  const bool short_;       ///< a product of codes has at most 32 bits
  const bool plain_sums_;  ///< products add up as they are
  const bool narrow_sums_; ///< a rounding accumulator stays within 63 bits
  const std::size_t per_cell_, lanes_;
  AlignedVector<std::int64_t> multiplier_; ///< by row, and
  std::vector<int> places_;                ///< what DrivePath makes of r
  AlignedVector<std::int32_t> in_;         ///< [tap][place] of the bank that fires: what it reads
};

} // namespace hopmesh::engine
