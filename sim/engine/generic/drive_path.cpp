#include "sim/engine/generic/drive_path.h"

#include "sim/engine/division.h"

namespace hopmesh::engine {

DrivePath::DrivePath(const NeuronPlan& plan)
    : plan_(plan), rule_(rounding_rule(plan.formats.drive.rounding)), limit_(plan.formats.drive) {
  if (plan.binary) return;
  if (plan.hold > 0) {
    narrow_ = holds_narrowly();
    if (narrow_ && plan.normaliser == spec::Normaliser::reciprocal)
      to_drive_ = shift_rounding(plan.multiplier_places, rule_);
  } else if (plan.normaliser == spec::Normaliser::prescaled && plan.scaled_down >= 0) {
    narrow_ = true;
    to_drive_ = shift_rounding(plan.scaled_down, rule_);
  } else if (multiplies_narrowly()) {
    narrow_ = true;
    to_drive_ = shift_rounding(plan.multiplier_places, rule_);
  } else {
    narrow_ = divides_narrowly();
    apart_ = multiplies_row_by_row();
  }
}

// s is held within `hold` times its divisor, and hold times gain is less than 2^6.
bool DrivePath::holds_narrowly() const {
  if (plan_.norm_up < 0 || plan_.norm_up + plan_.norm_bits > 55) return false;
  const int divisor = plan_.norm_bits + plan_.gain_places;
  if (plan_.normaliser == spec::Normaliser::divider)
    return plan_.ratio_up >= 0 && divisor <= 60 && divisor + plan_.formats.drive.fraction_bits() <= 54;
  const int places = plan_.multiplier_places;
  return places >= 0 && places <= 60 && plan_.norm_bits + plan_.reciprocal_bits + plan_.norm_up <= 55;
}

// With an exact accumulator |s| <= N, so a quotient has no more places than the drive.
bool DrivePath::divides_narrowly() const {
  return plan_.normaliser == spec::Normaliser::divider && plan_.exact && plan_.ratio_up >= 0 &&
         plan_.norm_bits + plan_.formats.drive.fraction_bits() <= 60;
}

bool DrivePath::multiplies_narrowly() const {
  if (plan_.normaliser != spec::Normaliser::reciprocal) return false;
  const int places = plan_.multiplier_places;
  const int multiplier =
      plan_.norm_bits + plan_.reciprocal_bits; // bits of r, moved to the point of the widest N's
  const int above = std::max(plan_.norm_up, 0);
  const int product = (plan_.exact ? above : plan_.formats.accumulator.width) + multiplier; // exact: |s| <= N
  return places >= 0 && places <= 60 && multiplier <= 61 && product <= 61;
}

// The more bits N has, from one to norm_bits, the further the product moves down.
bool DrivePath::multiplies_row_by_row() const {
  const int most = plan_.multiplier_places;
  const int least = plan_.reciprocal_bits - 1 - plan_.ratio_up;
  return plan_.normaliser == spec::Normaliser::reciprocal && !plan_.exact && least >= 0 && most <= 60 &&
         plan_.formats.accumulator.width + plan_.reciprocal_bits <= 61;
}

DrivePath::Inverse DrivePath::invert(std::uint64_t norm) const {
  if (norm == 0 || plan_.binary || plan_.normaliser != spec::Normaliser::reciprocal) return {};
  const std::int64_t r = reciprocal(norm, plan_.reciprocal_bits);
  const int below = plan_.norm_bits - bit_length(norm); // bits that this N has less than the widest
  if (!narrow_) return {r, r * plan_.gain, plan_.multiplier_places - below};
  return {r, (r * plan_.gain) << below, plan_.multiplier_places};
}

void DrivePath::drives(const Rows& rows, const std::int64_t* sum, std::int64_t* u) const {
  std::copy_n(sum, lane_count, u);
  if (plan_.binary) return sign_lanes(u, plan_.one_drive);
  if (plan_.hold > 0 && narrow_) return held_drives(rows, u);
  if (apart_) {
    scale_lanes_apart(u, rows.multiplier, rows.places, rule_);
    limit_lanes(u, limit_);
    return clamp_lanes(u, plan_.one_drive);
  }
  if (!narrow_) {
    for (std::size_t l = 0; l < lane_count; ++l)
      u[l] = drive({rows.norm + l, rows.multiplier + l, rows.places + l}, sum[l]);
    return;
  }
  const auto overflow = plan_.formats.drive.overflow; // a drive that saturates is then clamped to ±1 anyway
  if (plan_.normaliser == spec::Normaliser::reciprocal && overflow != spec::Overflow::wrap &&
      overflow != spec::Overflow::sat_zero)
    return scale_lanes(u, rows.multiplier, to_drive_, plan_.one_drive);
  if (plan_.normaliser == spec::Normaliser::divider) {
    divide_lanes(u, plan_.ratio_up, rows.norm, rule_);
  } else {
    if (plan_.normaliser == spec::Normaliser::reciprocal) multiply_lanes(u, rows.multiplier);
    round_lanes(u, to_drive_);
    limit_lanes(u, limit_);
  }
  clamp_lanes(u, plan_.one_drive);
}

// What is held back of s would only lead further beyond the limit.
void DrivePath::held_drives(const Rows& rows, std::int64_t* u) const {
  alignas(64) std::int64_t beyond[lane_count];
  hold_lanes(u, rows.norm, std::int64_t{plan_.hold} << plan_.norm_up, beyond);
  if (plan_.normaliser == spec::Normaliser::reciprocal) {
    multiply_lanes(u, rows.multiplier);
    round_lanes(u, to_drive_);
  } else {
    alignas(64) std::int64_t divisor[lane_count];
    for (std::size_t l = 0; l < lane_count; ++l) {
      divisor[l] = rows.norm[l] << plan_.gain_places;
      u[l] *= plan_.gain;
    }
    divide_lanes(u, plan_.ratio_up, divisor, rule_);
  }
  limit_held_lanes(u, beyond, plan_.most_drive);
}

// The same of one row, whatever its formats.
std::int64_t DrivePath::held_drive(const Rows& row, std::int64_t sum) const {
  const Int128 norm = *row.norm, limit = plan_.most_drive;
  if (norm == 0) return sum > 0 ? plan_.most_drive : sum < 0 ? -plan_.most_drive : 0;
  const int up = plan_.norm_up;
  const Int128 most = up >= 0 ? shifted_up<Int128>(norm * plan_.hold, up) : (norm * plan_.hold >> -up) + 1;
  const Int128 held = std::min(std::max<Int128>(sum, -most), most);
  Int128 u = 0;
  if (plan_.normaliser == spec::Normaliser::reciprocal)
    u = rounded(held * *row.multiplier, shift_rounding<Int128>(*row.places, rule_));
  else if (plan_.ratio_up < 0)
    u = round_quotient<Int128>(held * plan_.gain, norm << (plan_.gain_places - plan_.ratio_up), rule_);
  else
    u = round_quotient<Int128>(shifted_up<Int128>(held * plan_.gain, plan_.ratio_up),
                               norm << plan_.gain_places, rule_);
  return static_cast<std::int64_t>(std::min(std::max(u, -limit), limit));
}

std::int64_t DrivePath::drive(const Rows& row, std::int64_t sum) const {
  if (plan_.hold > 0) return held_drive(row, sum);
  return std::min(std::max(unlimited_drive(row, sum), -plan_.one_drive), plan_.one_drive);
}

std::int64_t DrivePath::unlimited_drive(const Rows& row, std::int64_t sum) const {
  if (plan_.binary) return sum > 0 ? plan_.one_drive : sum < 0 ? -plan_.one_drive : 0;
  if (plan_.hold > 0) return held_drive(row, sum);
  const std::int64_t norm = *row.norm;
  const int up = plan_.ratio_up;
  Int128 u = 0;
  if (plan_.normaliser == spec::Normaliser::prescaled)
    u = rounded(sum, shift_rounding<Int128>(plan_.scaled_down, rule_));
  else if (norm != 0 && plan_.normaliser == spec::Normaliser::reciprocal)
    u = rounded(Int128{sum} * *row.multiplier, shift_rounding<Int128>(*row.places, rule_));
  else if (norm != 0 && up < 0)
    u = round_quotient<Int128>(sum, Int128{norm} << -up, rule_);
  else if (norm != 0)
    u = round_quotient<Int128>(shifted_up<Int128>(sum, up), norm, rule_);
  return limited(u, limit_);
}

} // namespace hopmesh::engine
