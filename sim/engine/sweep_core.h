// The memories of an array and a sweep over them: what a way of computing has to offer. Two do: the generic
// core (generic/, any array) and the fast core (kernels/, 16-bit weights and links in wide registers).
#pragma once

#include "rtl_model/spec/relaxation.h"
#include "sim/engine/lane_extremes.h"
#include "sim/engine/layout.h"
#include "sim/engine/neuron_plan.h"

#include <memory>
#include <numeric>

namespace hopmesh::engine {

/// What fired blocks leave behind. A kernel writes `lanes`, the generic core the rest; whoever asks gets
/// both.
struct SweepRecord {
  LaneExtremes lanes;
  std::int64_t largest = 0;        ///< |Delta V|
  std::int64_t largest_moving = 0; ///< |s| of neurons that may still move, where it is asked for
  std::int64_t along = 0;          ///< the sum of sign(s) Delta V, of momentum
  spec::Extremes extremes;

  std::int64_t largest_change() const {
    std::int64_t most = largest;
    for (std::uint32_t change : lanes.largest_change) most = std::max<std::int64_t>(most, change);
    return most;
  }
  std::int64_t largest_sum() const {
    return std::max(largest_moving,
                    *std::max_element(std::begin(lanes.largest_moving), std::end(lanes.largest_moving)));
  }
  std::int64_t all_along() const {
    return std::accumulate(std::begin(lanes.along), std::end(lanes.along), along);
  }
  spec::Extremes all_extremes() const {
    spec::Extremes all = extremes;
    for (std::size_t l = 0; l < std::size(lanes.least_sum); ++l)
      all.merge({lanes.least_sum[l], lanes.largest_sum[l], lanes.least_drive[l], lanes.largest_drive[l]});
    return all;
  }
  void begin_sweep() {
    largest = largest_moving = along = 0;
    std::fill(std::begin(lanes.largest_change), std::end(lanes.largest_change), 0u);
    std::fill(std::begin(lanes.largest_moving), std::end(lanes.largest_moving), 0);
    std::fill(std::begin(lanes.along), std::end(lanes.along), 0);
  }
};

/// What the blocks of a sweep are told.
struct SweepOrder {
  std::uint32_t ahead = 0;   ///< sweeps begun before this one that end_sweeps() has not ended yet
  std::int32_t momentum = 0; ///< m, a code of spec::momentum_format
};

/// Codes are those that the array's memories hold: in range, |V| <= 1. A slot is a cell's place in the
/// Layout.
class SweepCore {
 public:
  virtual ~SweepCore() = default;

  virtual void put_weights(std::size_t slot, std::size_t p, std::size_t first_tap, const std::int32_t* codes,
                           std::size_t count) = 0;
  virtual std::int32_t weight(std::size_t slot, std::size_t p, std::size_t tap) const = 0;
  virtual void put_bias(std::size_t slot, std::size_t p, std::int32_t code) = 0;
  virtual std::int32_t bias(std::size_t slot, std::size_t p) const = 0;
  virtual void put_state(std::size_t slot, std::size_t p, std::int32_t code) = 0;
  virtual std::int32_t state(std::size_t slot, std::size_t p) const = 0;

  /// N of every row and its reciprocal, for blocks [first, last).
  virtual void prepare(std::size_t first, std::size_t last) = 0;
  /// Called after all blocks were prepared and before the first sweep. `by_sum`: the largest |s| is asked
  /// for.
  virtual void begin_run(bool by_sum) = 0;
  /// Fires every neuron of the blocks [first, last), as if one after the other; of one group or of several.
  virtual void fire(std::size_t first, std::size_t last, const SweepOrder& order, SweepRecord& record) = 0;
  /// Called after the last groups of so many sweeps: synchronous arrays show their new outputs now.
  virtual void end_sweeps(std::uint32_t /*count*/) {}
  /// Momentum: Y takes the value of V, and neighbours see it.
  virtual void restart() {}

  /// Keep the outputs as they are now, and bring them back when sweeps went too far.
  virtual void keep_outputs() = 0;
  virtual void restore_outputs() = 0;
  /// Bytes that a sweep reads and writes, for rooflines.
  virtual std::size_t bytes_per_sweep() const = 0;
  /// "generic", or the kernel's name.
  virtual const char* name() const = 0;
};

} // namespace hopmesh::engine
