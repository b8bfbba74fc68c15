#include "sim/engine/generic/drive_path.h"

#include "sim/engine/kernels/fast_plan.h"
#include "sim/engine/rounding.h"

namespace hopmesh::engine {

DrivePath::DrivePath(const Plan& plan) : plan_(plan), norm_bits_(norm_bits(plan)) {
  const spec::Rounding mode = plan.formats.drive.rounding;
  if (plan.binary) return;
  if (plan.normaliser == spec::Normaliser::prescaled && plan.scaled_down >= 0) {
    narrow_ = true;
    to_drive_ = lane_rounding(plan.scaled_down, mode);
  } else if (multiplies_narrowly()) {
    narrow_ = true;
    to_drive_ = lane_rounding(multiplier_places(plan), mode);
  } else {
    narrow_ = divides_narrowly();
    apart_ = multiplies_row_by_row();
  }
}

// With an exact accumulator |s| <= N, so a quotient has no more places than the drive.
bool DrivePath::divides_narrowly() const {
  return plan_.normaliser == spec::Normaliser::divider && plan_.exact && plan_.ratio_up >= 0 &&
         norm_bits_ + plan_.formats.drive.fraction_bits() <= 60;
}

bool DrivePath::multiplies_narrowly() const {
  if (plan_.normaliser != spec::Normaliser::reciprocal) return false;
  const int places = multiplier_places(plan_);
  const int multiplier =
      norm_bits_ + plan_.reciprocal_bits; // bits of r, moved to the point of the widest N's
  const int above =                       // from N's last place to that of s
      std::max(plan_.formats.drive.fraction_bits() - plan_.ratio_up, 0);
  const int product = (plan_.exact ? above : plan_.formats.accumulator.width) + multiplier; // exact: |s| <= N
  return places >= 0 && places <= 60 && multiplier <= 61 && product <= 61;
}

// r has reciprocal_bits of its own, and N from one to norm_bits_: that decides how far their product goes
// down.
bool DrivePath::multiplies_row_by_row() const {
  const int most = norm_bits_ + plan_.reciprocal_bits - 2 - plan_.ratio_up;
  const int least = plan_.reciprocal_bits - 1 - plan_.ratio_up;
  return plan_.normaliser == spec::Normaliser::reciprocal && !plan_.exact && least >= 0 && most <= 60 &&
         plan_.formats.accumulator.width + plan_.reciprocal_bits <= 61;
}

DrivePath::Inverse DrivePath::invert(std::uint64_t norm) const {
  if (norm == 0 || plan_.binary || plan_.normaliser != spec::Normaliser::reciprocal) return {};
  const int exponent = bit_length(norm) + plan_.reciprocal_bits - 2;
  const std::int64_t r = exponent < 63
                             ? static_cast<std::int64_t>((std::uint64_t{1} << exponent) / norm)
                             : static_cast<std::int64_t>((Int128{1} << exponent) / static_cast<Int128>(norm));
  if (!narrow_) return {r, r, exponent - plan_.ratio_up};
  return {r, r << (norm_bits_ - bit_length(norm)), multiplier_places(plan_)};
}

void DrivePath::drives(const Rows& rows, const std::int64_t* sum, std::int64_t* u) const {
  std::copy_n(sum, lane_count, u);
  if (plan_.binary) return sign_lanes(u, plan_.one_drive);
  if (apart_) {
    scale_lanes_apart(u, rows.multiplier, rows.places, plan_.formats.drive.rounding);
    limit_lanes(u, plan_.formats.drive);
    return clamp_lanes(u, plan_.one_drive);
  }
  if (!narrow_) {
    for (std::size_t l = 0; l < lane_count; ++l)
      u[l] = drive({rows.norm + l, rows.multiplier + l, rows.places + l}, sum[l]);
    return;
  }
  const auto overflow = plan_.formats.drive.overflow; // those that saturate end beyond the limiter
  if (plan_.normaliser == spec::Normaliser::reciprocal && overflow != spec::Overflow::wrap &&
      overflow != spec::Overflow::sat_zero)
    return scale_lanes(u, rows.multiplier, to_drive_, plan_.one_drive);
  if (plan_.normaliser == spec::Normaliser::divider) {
    divide_lanes(u, plan_.ratio_up, rows.norm, plan_.formats.drive.rounding);
  } else {
    if (plan_.normaliser == spec::Normaliser::reciprocal) multiply_lanes(u, rows.multiplier);
    round_lanes(u, to_drive_);
    limit_lanes(u, plan_.formats.drive);
  }
  clamp_lanes(u, plan_.one_drive);
}

std::int64_t DrivePath::drive(const Rows& row, std::int64_t sum) const {
  if (plan_.binary) return sum > 0 ? plan_.one_drive : sum < 0 ? -plan_.one_drive : 0;
  const spec::NumberFormat& f = plan_.formats.drive;
  const std::int64_t norm = *row.norm;
  const int up = plan_.ratio_up;
  Int128 u = 0;
  if (plan_.normaliser == spec::Normaliser::prescaled)
    u = round_shift<Int128>(sum, plan_.scaled_down, f.rounding);
  else if (norm != 0 && plan_.normaliser == spec::Normaliser::reciprocal)
    u = round_shift<Int128>(Int128{sum} * *row.multiplier, *row.places, f.rounding);
  else if (norm != 0 && up < 0)
    u = round_quotient<Int128>(sum, Int128{norm} << -up, f.rounding);
  else if (norm != 0)
    u = round_quotient<Int128>(shifted_up<Int128>(sum, up), norm, f.rounding);
  return std::min(std::max(limit_to_format(u, f), -plan_.one_drive), plan_.one_drive);
}

} // namespace hopmesh::engine
