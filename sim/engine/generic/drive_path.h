// From s and N to u: sixteen rows at a time in 64 bits where those hold every code, one by one in 128 where
// not.
#pragma once

#include "sim/engine/generic/lanes.h"
#include "sim/engine/plan.h"

namespace hopmesh::engine {

class DrivePath {
 public:
  explicit DrivePath(const Plan& plan);

  /// What a row keeps of its N: the register r; r as s is multiplied by it (where all rows share one point,
  /// moved up to that); and how far the product is moved down. Zeros where N is, and without reciprocals.
  struct Inverse {
    std::int64_t reciprocal = 0, multiplier = 0;
    int places = 0;
  };
  Inverse invert(std::uint64_t norm) const;

  /// N and what Inverse holds of rows side by side.
  struct Rows {
    const std::int64_t *norm, *multiplier;
    const int* places;
  };
  /// u <- the limited drives of lane_count rows.
  void drives(const Rows& rows, const std::int64_t* sum, std::int64_t* u) const;
  /// Of one row.
  std::int64_t drive(const Rows& row, std::int64_t sum) const;

 private:
  bool divides_narrowly() const;
  bool multiplies_narrowly() const;
  bool multiplies_row_by_row() const;

  const Plan& plan_;
  const int norm_bits_; ///< of the largest N that these formats can make
  bool narrow_ = false; ///< s stays within 63 bits on its way to u, and all reciprocals share a point
  bool apart_ = false;  ///< it stays so only if every row keeps a point of its own
  LaneRounding to_drive_;
};

} // namespace hopmesh::engine
