#include "rtl_model/systemc/output_stage.h"

#include "rtl_model/systemc/trace.h"

namespace hopmesh::systemc {

namespace {

int bit_length(std::int64_t x) {
  return x == 0 ? 0 : 64 - __builtin_clzll(static_cast<std::uint64_t>(x));
}

std::int64_t limited(std::int64_t x, std::int64_t bound) {
  return x > bound ? bound : x < -bound ? -bound : x;
}

} // namespace

OutputStage::OutputStage(sc_core::sc_module_name name, const Datapath& path, std::size_t neurons)
    : sc_module(name), path_(path), many_(neurons == 1 ? 0 : neurons),
      memory_(neurons == 1 ? &only_ : many_.data()) {}

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
  if (path_.ratio_up < 0) return round_quotient<Wide>(sum_raw, Wide{norm} << -path_.ratio_up, mode);
  if (path_.narrow)
    return round_quotient<std::int64_t>(sum_raw * (std::int64_t{1} << path_.ratio_up), norm, mode);
  return round_quotient<Wide>(Wide{sum_raw} * (Wide{1} << path_.ratio_up), norm, mode);
}

// Behind a sign, R u is a whole number of the state's last places: nothing is left to round, V gets to its
// bound at once, and stays where s is zero.
void OutputStage::normalise(std::int64_t sum_raw, std::size_t place) {
  if (path_.binary) {
    ratio_ = drive_ = limited(sum_raw, 1) * path_.formats.drive.one_raw();
    return;
  }
  const Memory& of = memory_[place];
  const auto mode = path_.formats.drive.rounding;
  Wide ratio = 0;
  if (path_.normaliser == spec::Normaliser::prescaled)
    ratio = round_places<Wide>(sum_raw, path_.scaled_down, mode);
  else if (of.norm != 0 && path_.normaliser == spec::Normaliser::divider)
    ratio = exact_ratio(sum_raw, of.norm);
  else if (of.norm != 0)
    ratio = round_places<Wide>(Wide{sum_raw} * of.reciprocal, of.reciprocal_places, mode);
  ratio_ = into_range(ratio, path_.formats.drive);
  drive_ = limited(ratio_, path_.formats.drive.one_raw());
}

void OutputStage::bias_by_r(std::int64_t drive_raw, std::size_t place) {
  const std::int64_t one = path_.formats.state.one_raw(), state = memory_[place].state;
  pull_ = drive_raw >= 0 ? one - state : one + state;
  product_ = pull_ * drive_raw;
  delta_ =
      round_places<std::int64_t>(product_, path_.formats.drive.fraction_bits(), path_.formats.state.rounding);
}

std::int64_t OutputStage::publish(std::size_t place) {
  memory_[place].state += delta_;
  return delta_ < 0 ? -delta_ : delta_;
}

std::int32_t OutputStage::link_raw(std::size_t place) const {
  return static_cast<std::int32_t>(
      round_places(memory_[place].state, path_.link_down, path_.formats.link.rounding));
}

void OutputStage::load(std::int32_t raw, std::size_t place) {
  const int unused = 32 - path_.formats.state.width;
  const std::int32_t cut = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw) << unused) >> unused;
  memory_[place].state = limited(cut, path_.formats.state.one_raw());
}

void OutputStage::trace(sc_core::sc_trace_file* file) const {
  const spec::NeuronSignals signals = spec::neuron_signals(path_.formats);
  trace_register(file, drive_, *this, signals.drive);
  trace_register(file, delta_, *this, signals.change);
}

void OutputStage::trace_state(sc_core::sc_trace_file* file, const std::string& scope,
                              std::size_t place) const {
  const spec::Signal signal = spec::neuron_signals(path_.formats).state;
  sc_core::sc_trace(file, memory_[place].state, scope + "." + signal.name, signal.width);
}

} // namespace hopmesh::systemc
