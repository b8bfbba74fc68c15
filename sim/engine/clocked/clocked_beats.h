// Registers of every neuron and what one beat does to them, row by row or in lanes.
#pragma once

#include "sim/engine/aligned.h"
#include "sim/engine/clocked/clocked_layout.h"
#include "sim/engine/generic/drive_path.h"
#include "sim/engine/generic/wide_sum.h"
#include "sim/engine/run_rule.h"

namespace hopmesh::engine {

/// Memories and registers by row (ClockedLayout), as they stand after a clock.
struct ClockedRegisters {
  AlignedVector<std::int32_t> weight;             ///< ClockedLayout::weight
  AlignedVector<std::int32_t> bias, state, link;  ///< I, V, and V, or Y, as neighbours see it
  AlignedVector<std::int32_t> extrapolated;       ///< Y, of momentum
  AlignedVector<std::int64_t> norm, reciprocal;   ///< N, r
  AlignedVector<std::int64_t> sum, drive, change; ///< s, u, Delta V
};

class ClockedBeats {
 public:
  ClockedBeats(const NeuronPlan& plan, const ClockedLayout& layout);

  ClockedRegisters at;

  /// The host writes V of a neuron, and its link follows.
  void load(std::size_t cell, std::size_t p, std::int32_t state);

  // The segment prepare: N of all rows of a bank, in beats [first, last); in the end its reciprocal.
  void begin_norms(const ClockedBank& bank);
  void add_norms(const ClockedBank& bank, std::uint64_t first, std::uint64_t last);
  void invert(const ClockedBank& bank);

  /// Copies the links that rows of a bank read: those of their own cell, and with `neighbours` those of the
  /// neighbours too.
  void take_links(const ClockedBank& bank, bool neighbours);
  void begin_sums(const ClockedBank& bank, std::size_t p);
  void add_beats(const ClockedBank& bank, std::size_t p, std::uint64_t first, std::uint64_t last);
  /// s to u, then u to Delta V, of rows [first, last).
  void normalise(std::size_t first, std::size_t last);
  void move(std::size_t first, std::size_t last);
  /// Is each beat one tap whose product is only added to the sum? Then tap_adder() does it.
  bool plain() const { return plain_sums_ && lanes_ == 1; }
  using TapAdder = void (*)(const std::int32_t* weights, const std::int32_t* inputs, std::size_t rows,
                            std::int64_t* sums);
  TapAdder tap_adder() const;
  const std::int32_t* inputs() const { return in_.data(); }
  /// Neuron p of all cells: what the detector sees of it; then V, Y and link take their new values.
  void detect(const ClockedBank& bank, std::size_t p, bool by_sum, Detected& detected) const;
  void publish(const ClockedBank& bank, std::size_t p, std::int32_t momentum, Detected& detected);
  /// Y takes the value of V.
  void restart();

 private:
  void add_own_taps(const ClockedBank& bank, std::size_t tap, std::size_t end);
  /// A group of taps: their weights, their inputs, and the strides from one tap to the next.
  struct Taps {
    const std::int32_t* weights;
    std::size_t weight_stride;
    const std::int32_t* inputs;
    std::size_t input_stride, count;
  };

  /// Rows [row, row + rows) of the taps; `sums` is that of the first.
  void add(const Taps& taps, std::size_t row, std::size_t rows, std::int64_t* sums) const;
  void add_rounded(const Taps& taps, std::size_t rows, std::int64_t* sums) const;

  const NeuronPlan& plan_;
  const ClockedLayout& layout_;
  const DrivePath path_;
  const WideSum wide_sum_;
  const Limit sum_limit_;
  const ShiftRounding to_state_, to_link_, gained_;
  const StepRounding step_;
  ShiftRounding to_sum_;
  const bool short_;       ///< a product of codes has at most 32 bits
  const bool plain_sums_;  ///< products add up as they are
  const bool narrow_sums_; ///< a rounding accumulator stays within 63 bits
  const std::size_t per_cell_, lanes_;
  AlignedVector<std::int64_t> multiplier_; ///< Inverse::multiplier of each row
  std::vector<int> places_;                ///< Inverse::places of each row
  AlignedVector<std::int32_t> in_;         ///< what the bank that fires reads: [tap][place]
};

} // namespace hopmesh::engine
