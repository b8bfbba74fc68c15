#include "rtl_model/systemc/output_stage.h"

namespace hopmesh::systemc {

namespace {

int norm_fraction(const spec::Formats& f) {
  return std::max(f.weight.fraction_bits(), f.bias.fraction_bits());
}

int bit_length(std::int64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(static_cast<std::uint64_t>(x));
}

std::int64_t limited(std::int64_t x, std::int64_t bound) {
  return x > bound ? bound : x < -bound ? -bound : x;
}

} // namespace

OutputStage::OutputStage(sc_core::sc_module_name name, const spec::ArraySpec& array,
                         const spec::NumberFormat& accumulator)
    : sc_module(name), normaliser_(array.normaliser), drive_format_(array.formats.drive),
      state_format_(array.formats.state), link_format_(array.formats.link),
      reciprocal_bits_(array.reciprocal_bits),
      ratio_up_(drive_format_.fraction_bits() + norm_fraction(array.formats) - accumulator.fraction_bits()),
      scaled_places_(accumulator.fraction_bits() - drive_format_.fraction_bits()),
      narrow_(accumulator.width + ratio_up_ <= 62) {}

// N lies in [2^(B-1), 2^B); its reciprocal's mantissa is cut, never rounded up, so that |u| <= |s| / N.
void OutputStage::set_norm(std::int64_t norm_raw) {
  norm_ = norm_raw;
  if (normaliser_ != spec::Normaliser::reciprocal || norm_ == 0) return;
  const int exponent = bit_length(norm_) + reciprocal_bits_ - 2;
  reciprocal_ = static_cast<std::int64_t>((Wide{1} << exponent) / norm_);
  reciprocal_places_ = exponent - ratio_up_;
}

Wide OutputStage::exact_ratio(std::int64_t sum_raw) const {
  const auto mode = drive_format_.rounding;
  if (ratio_up_ < 0) return round_quotient<Wide>(sum_raw, Wide{norm_} << -ratio_up_, mode);
  if (narrow_) return round_quotient<std::int64_t>(sum_raw * (std::int64_t{1} << ratio_up_), norm_, mode);
  return round_quotient<Wide>(Wide{sum_raw} * (Wide{1} << ratio_up_), norm_, mode);
}

void OutputStage::normalise(std::int64_t sum_raw) {
  const auto mode = drive_format_.rounding;
  Wide ratio = 0;
  if (normaliser_ == spec::Normaliser::prescaled)
    ratio = round_places<Wide>(sum_raw, scaled_places_, mode);
  else if (norm_ != 0 && normaliser_ == spec::Normaliser::divider)
    ratio = exact_ratio(sum_raw);
  else if (norm_ != 0)
    ratio = round_places<Wide>(Wide{sum_raw} * reciprocal_, reciprocal_places_, mode);
  drive_ = limited(into_range(ratio, drive_format_), drive_format_.one_raw());
}

void OutputStage::bias_by_r() {
  const std::int64_t one = state_format_.one_raw(), r = drive_ >= 0 ? one - state_ : one + state_;
  delta_ = round_places<std::int64_t>(r * drive_, drive_format_.fraction_bits(), state_format_.rounding);
}

std::int64_t OutputStage::publish() {
  state_ += delta_;
  return delta_ < 0 ? -delta_ : delta_;
}

std::int32_t OutputStage::link_raw() const {
  const int places = state_format_.fraction_bits() - link_format_.fraction_bits();
  return static_cast<std::int32_t>(round_places(state_, places, link_format_.rounding));
}

void OutputStage::load(std::int32_t raw) {
  const int unused = 32 - state_format_.width;
  const std::int32_t cut = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw) << unused) >> unused;
  state_ = limited(cut, state_format_.one_raw());
}

void OutputStage::trace(sc_core::sc_trace_file* file) const {
  sc_core::sc_trace(file, drive_, std::string(name()) + ".u", drive_format_.width);
  sc_core::sc_trace(file, delta_, std::string(name()) + ".delta", state_format_.width + 1);
  sc_core::sc_trace(file, state_, std::string(name()) + ".V", state_format_.width);
}

} // namespace hopmesh::systemc
