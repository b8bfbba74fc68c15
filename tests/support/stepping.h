// The stages that step further as docs/hardware/datapath.md has them, in plain whole numbers.
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::tests {

/// x / d (d above 0) as a whole number, by the textbook.
inline std::int64_t textbook_quotient(std::int64_t x, std::int64_t d, spec::Rounding mode) {
  const std::int64_t floor = x >= 0 ? x / d : -((-x + d - 1) / d), twice = 2 * (x - floor * d);
  const bool up[] = {twice >= d,
                     twice > d || (twice == d && x < 0),
                     twice > d,
                     twice > d || (twice == d && x >= 0),
                     twice > d || (twice == d && floor % 2 != 0),
                     false,
                     twice > 0 && x < 0};
  return floor + up[static_cast<int>(mode)];
}

/// Codes of V and Y count in the state's last place.
class Stepping {
 public:
  Stepping(int drive_fraction, const spec::NumberFormat& state)
      : drive_fraction_(drive_fraction), fraction_(state.fraction_bits()), mode_(state.rounding),
        one_(state.one_raw()) {}

  std::int64_t step(std::int64_t u) const { return rounded(u, drive_fraction_ - fraction_); }
  std::int64_t moved(std::int64_t from, std::int64_t u) const { return limited(from + step(u)); }
  std::int64_t ahead(std::int64_t V, std::int64_t change, std::int64_t m) const {
    return limited(V + rounded(m * change, 15));
  }

 private:
  std::int64_t limited(std::int64_t x) const { return x > one_ ? one_ : x < -one_ ? -one_ : x; }
  std::int64_t rounded(std::int64_t x, int places) const {
    return places <= 0 ? x * (std::int64_t{1} << -places)
                       : textbook_quotient(x, std::int64_t{1} << places, mode_);
  }

  int drive_fraction_, fraction_;
  spec::Rounding mode_;
  std::int64_t one_;
};

} // namespace hopmesh::tests
