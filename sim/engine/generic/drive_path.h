// From s and N to u: sixteen rows at a time where 64 bits hold every code on the way, else row by row in 128
// bits.
#pragma once

#include "sim/engine/generic/lane_arithmetic.h"
#include "sim/engine/neuron_plan.h"

namespace hopmesh::engine {

class DrivePath {
 public:
  explicit DrivePath(const NeuronPlan& plan);

  /// What a row keeps of its N; zeros where N is zero, and in arrays without reciprocals.
  struct Inverse {
    std::int64_t reciprocal = 0; ///< the register r
    std::int64_t multiplier = 0; ///< of s: gain r, or that moved up to the one point that all rows share
    int places = 0;              ///< by which the product moves down to the drive's last place
  };
  Inverse invert(std::uint64_t norm) const;

  /// What divides s, and what Inverse holds, of rows side by side.
  struct Rows {
    const std::int64_t *norm, *multiplier;
    const int* places;
  };
  /// u <- the limited drives of lane_count rows.
  void drives(const Rows& rows, const std::int64_t* sum, std::int64_t* u) const;
  /// The limited drive of one row.
  std::int64_t drive(const Rows& row, std::int64_t sum) const;
  /// What the limiter holds within [-1, 1]: a code of the drive. Where u is limited before it is rounded,
  /// that is u itself.
  std::int64_t unlimited_drive(const Rows& row, std::int64_t sum) const;

 private:
  void held_drives(const Rows& rows, std::int64_t* u) const;
  std::int64_t held_drive(const Rows& row, std::int64_t sum) const;
  bool holds_narrowly() const;
  bool divides_narrowly() const;
  bool multiplies_narrowly() const;
  bool multiplies_row_by_row() const;

  const NeuronPlan& plan_;
  const RoundingRule rule_; ///< of the drive
  const Limit limit_;
  bool narrow_ = false; ///< s stays within 63 bits on its way to u, and all reciprocals share a point
  bool apart_ = false;  ///< s stays so only if every reciprocal keeps a point of its own
  ShiftRounding to_drive_;
};

} // namespace hopmesh::engine
