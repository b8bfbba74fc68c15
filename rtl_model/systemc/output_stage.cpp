#include "rtl_model/systemc/output_stage.h"

#include "rtl_model/systemc/trace.h"

namespace hopmesh::systemc {

namespace {

int bit_length(std::int64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(static_cast<std::uint64_t>(x));
}

template <typename Integer> std::int64_t limited(Integer x, std::int64_t bound) {
  return x > bound ? bound : x < -bound ? -bound : static_cast<std::int64_t>(x);
}

} // namespace

OutputStage::OutputStage(sc_core::sc_module_name name, const Datapath& path, std::size_t neurons)
    : sc_module(name), path_(path), has_momentum_(path.output == spec::Output::momentum),
      many_(neurons == 1 ? 0 : neurons), memory_(neurons == 1 ? &only_ : many_.data()) {}

// N lies in [2^(B-1), 2^B); its reciprocal's mantissa is cut, never rounded up, so that |u| <= |s| / N.
void OutputStage::set_norm(std::int64_t norm_raw, std::size_t place) {
  Memory& of = memory_[place];
  of.norm = norm_raw;
  if (path_.normaliser != spec::Normaliser::reciprocal || of.norm == 0) return;
  const int exponent = bit_length(of.norm) + path_.reciprocal_bits - 2;
  of.reciprocal = static_cast<std::int64_t>((Wide{1} << exponent) / of.norm);
  of.reciprocal_places = exponent - path_.ratio_up;
}

Wide OutputStage::exact_ratio(std::int64_t sum_raw, std::int64_t norm) const {
  const auto mode = path_.formats.drive.rounding;
  const int up = path_.quotient_up;
  if (up < 0) return round_quotient<Wide>(Wide{sum_raw} * path_.factor, Wide{norm} << -up, mode);
  if (path_.narrow)
    return round_quotient<std::int64_t>(sum_raw * path_.factor * (std::int64_t{1} << up), norm, mode);
  return round_quotient<Wide>(Wide{sum_raw} * path_.factor * (Wide{1} << up), norm, mode);
}

Wide OutputStage::ratio_of(std::int64_t sum_raw, const Memory& of) const {
  const auto mode = path_.formats.drive.rounding;
  if (path_.normaliser == spec::Normaliser::prescaled)
    return round_places<Wide>(sum_raw, path_.scaled_down, mode);
  if (of.norm == 0) return 0;
  if (path_.normaliser == spec::Normaliser::divider) return exact_ratio(sum_raw, of.norm);
  return round_places<Wide>(Wide{sum_raw} * of.reciprocal * path_.factor,
                            of.reciprocal_places + path_.factor_down, mode);
}

// Behind a sign, R u is a whole number of the state's last places: nothing is left to round, V gets to its
// bound at once, and stays where s is zero. A step may want more than the drive's format has: its bounds come
// before the format, whose overflow mode never acts.
void OutputStage::normalise(std::int64_t sum_raw, std::size_t place) {
  const std::int64_t one = path_.formats.drive.one_raw();
  const Memory& of = memory_[place];
  if (path_.binary) {
    ratio_ = drive_ = limited<std::int64_t>(sum_raw, 1) * one;
  } else if (path_.output == spec::Output::modified) {
    ratio_ = into_range(ratio_of(sum_raw, of), path_.formats.drive);
    drive_ = limited(ratio_, one);
  } else {
    const std::int64_t bound = has_momentum_ ? one : 2 * one;
    ratio_ = drive_ =
        of.norm == 0 ? limited<std::int64_t>(sum_raw, 1) * bound : limited(ratio_of(sum_raw, of), bound);
  }
}

void OutputStage::find_change(std::int64_t drive_raw, std::size_t place) {
  const spec::NumberFormat& format = path_.formats.state;
  const std::int64_t one = format.one_raw(), state = memory_[place].state;
  if (path_.binary || path_.output == spec::Output::modified) {
    pull_ = drive_raw >= 0 ? one - state : one + state;
    product_ = pull_ * drive_raw;
    delta_ = round_places<std::int64_t>(product_, path_.formats.drive.fraction_bits(), format.rounding);
    return;
  }
  const std::int64_t step = round_places<std::int64_t>(drive_raw, path_.step_down, format.rounding);
  delta_ = limited(memory_[place].*base() + step, one) - state;
}

bool OutputStage::is_held(std::int64_t sum_raw, std::size_t place) const {
  const std::int64_t one = path_.formats.link.one_raw(), shown = link_raw(place);
  return (shown == one && sum_raw >= 0) || (shown == -one && sum_raw <= 0);
}

std::int64_t OutputStage::publish(std::size_t place, std::int64_t momentum_raw) {
  Memory& of = memory_[place];
  of.state += delta_;
  if (!has_momentum_) return delta_;
  const spec::NumberFormat& format = path_.formats.state;
  product_ = momentum_raw * delta_;
  of.extrapolated =
      limited(of.state + round_places<std::int64_t>(product_, spec::momentum_down, format.rounding),
              format.one_raw());
  return delta_;
}

void OutputStage::settle(std::size_t place) {
  memory_[place].extrapolated = memory_[place].state;
}

std::int32_t OutputStage::link_raw(std::size_t place) const {
  return static_cast<std::int32_t>(
      round_places(memory_[place].*base(), path_.link_down, path_.formats.link.rounding));
}

void OutputStage::load(std::int32_t raw, std::size_t place) {
  const int unused = 32 - path_.formats.state.width;
  const std::int32_t cut = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw) << unused) >> unused;
  memory_[place].state = limited(cut, path_.formats.state.one_raw());
  settle(place);
}

void OutputStage::trace(sc_core::sc_trace_file* file) const {
  const spec::NeuronSignals signals = spec::neuron_signals(path_.formats, path_.output);
  trace_register(file, drive_, *this, signals.drive);
  trace_register(file, delta_, *this, signals.change);
}

void OutputStage::trace_state(sc_core::sc_trace_file* file, const std::string& scope,
                              std::size_t place) const {
  const spec::NeuronSignals signals = spec::neuron_signals(path_.formats);
  const auto trace = [&](const std::int64_t& raw, const spec::Signal& signal) {
    sc_core::sc_trace(file, raw, scope + "." + signal.name, signal.width);
  };
  trace(memory_[place].state, signals.state);
  if (has_momentum_) trace(memory_[place].extrapolated, signals.extrapolated);
}

} // namespace hopmesh::systemc
