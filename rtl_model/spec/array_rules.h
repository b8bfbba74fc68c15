// Which arrays can be built (validate) and the ones that have names (presets).
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::spec {

/// A rule that an array broke: the key as scene and array files write it, what stands there, what should.
struct SpecFault {
  std::string key, found, expected;
};

namespace detail {

inline std::optional<SpecFault> format_fault(const char* key, const NumberFormat& f, int least_integer_bits) {
  const std::string found = f.text();
  if (f.width < 4 || f.width > 32) return SpecFault{key, found, "4 to 32 bits"};
  if (f.integer_bits < least_integer_bits || f.integer_bits >= f.width)
    return SpecFault{key, found,
                     "from " + std::to_string(least_integer_bits) +
                         " integer bits to one less than the width" +
                         (least_integer_bits == 2 ? " (+1 needs two)" : "")};
  return std::nullopt;
}

inline std::optional<SpecFault> accumulator_fault(const ArraySpec& a, std::size_t taps) {
  const NumberFormat exact = exact_accumulator_format(a.formats, taps);
  if (exact.width > 62)
    return SpecFault{"formats.weight", a.formats.weight.text(),
                     "formats whose exact sum fits 62 bits (this one needs " + std::to_string(exact.width) +
                         " for rows of " + std::to_string(taps) + " inputs)"};
  if (a.exact_accumulator) return std::nullopt;
  const NumberFormat& f = a.formats.accumulator;
  if (f.width < 4 || f.width > 62 || f.integer_bits < 1 || f.fraction_bits() < 0)
    return SpecFault{"formats.accumulator", f.text(), "4 to 62 bits, at least 1 of them before the point"};
  if (f.fraction_bits() > exact.fraction_bits())
    return SpecFault{"formats.accumulator", f.text(),
                     "at most the " + std::to_string(exact.fraction_bits()) + " fraction bits of a product"};
  return std::nullopt;
}

} // namespace detail

/// Nothing if the array can be built for rows of at most `taps` inputs, else the first rule it breaks.
inline std::optional<SpecFault> validate(const ArraySpec& a, std::size_t taps = 1) {
  const Formats& f = a.formats;
  if (auto fault = detail::format_fault("formats.weight", f.weight, 1)) return fault;
  if (auto fault = detail::format_fault("formats.bias", f.bias, 1)) return fault;
  if (auto fault = detail::format_fault("formats.drive", f.drive, 2)) return fault;
  if (auto fault = detail::format_fault("formats.state", f.state, 2)) return fault;
  if (auto fault = detail::format_fault("formats.link", f.link, 2)) return fault;
  if (f.link.fraction_bits() > f.state.fraction_bits())
    return SpecFault{"formats.link", f.link.text(),
                     "at most the state's " + std::to_string(f.state.fraction_bits()) + " fraction bits"};
  if (auto fault = detail::accumulator_fault(a, taps)) return fault;
  if (a.lanes < 1 || a.lanes > 64) return SpecFault{"array.lanes", std::to_string(a.lanes), "1 to 64"};
  if (a.reciprocal_bits < 4 || a.reciprocal_bits > 32)
    return SpecFault{"array.reciprocal_bits", std::to_string(a.reciprocal_bits), "4 to 32"};
  if (a.bus_bits != 32 && a.bus_bits != 64 && a.bus_bits != 128)
    return SpecFault{"array.bus_bits", std::to_string(a.bus_bits), "32, 64 or 128"};
  if (!(a.clock_mhz > 0 && a.clock_mhz <= 10000))
    return SpecFault{"array.clock_mhz", std::to_string(a.clock_mhz), "above 0, at most 10000"};
  return std::nullopt;
}

/// `descent`: exact sums, state = link, all rounding toward zero: the energy can only fall
/// (docs/method/theory.md, section 3).
inline ArraySpec descent_array() {
  ArraySpec a;
  a.name = "descent";
  return a;
}

/// `guarded`: state with eight guard bits behind the link, everything rounded to nearest, truncated
/// reciprocal.
inline ArraySpec guarded_array() {
  ArraySpec a;
  a.name = "guarded";
  a.normaliser = Normaliser::reciprocal;
  a.formats.drive = NumberFormat{18, 2, Rounding::rnd, Overflow::sat};
  a.formats.state = NumberFormat{24, 2, Rounding::rnd, Overflow::sat};
  a.formats.link = NumberFormat{16, 2, Rounding::rnd, Overflow::sat};
  return a;
}

/// `prescaled`: the host divides every row by its N, so the cell needs neither divider nor reciprocal.
inline ArraySpec prescaled_array() {
  ArraySpec a = guarded_array();
  a.name = "prescaled";
  a.normaliser = Normaliser::prescaled;
  a.formats.weight = NumberFormat{16, 1, Rounding::trn_zero, Overflow::sat};
  a.formats.bias = NumberFormat{16, 1, Rounding::trn_zero, Overflow::sat};
  return a;
}

/// `byte`: eight bits everywhere: the smallest array that still moves, for exploring.
inline ArraySpec byte_array() {
  ArraySpec a;
  a.name = "byte";
  a.formats.weight = NumberFormat{8, 1, Rounding::rnd, Overflow::sat};
  a.formats.bias = NumberFormat{12, 5, Rounding::rnd, Overflow::sat};
  a.formats.drive = a.formats.state = a.formats.link = NumberFormat{8, 2, Rounding::trn_zero, Overflow::sat};
  return a;
}

inline std::vector<ArraySpec> presets() {
  return {guarded_array(), descent_array(), prescaled_array(), byte_array()};
}

/// The array used where none is named; chosen by measurement, docs/decisions/0002-default-array.md.
inline ArraySpec default_array() {
  return guarded_array();
}

inline std::optional<ArraySpec> preset(const std::string& name) {
  for (const ArraySpec& a : presets())
    if (a.name == name) return a;
  return std::nullopt;
}

} // namespace hopmesh::spec
