// Arrays that have names.
#pragma once

#include "rtl_model/spec/array_spec.h"

#include <optional>

namespace hopmesh::spec {

/// `guarded`: state with eight guard bits behind the link, everything rounded to nearest, truncated
/// reciprocal. What an array is that nobody changed.
inline ArraySpec guarded_array() {
  return {};
}

/// `descent`: exact sums, state = link, all rounding toward zero: the energy can only fall
/// (docs/method/theory.md, section 3).
inline ArraySpec descent_array() {
  ArraySpec a;
  a.name = "descent";
  a.normaliser = Normaliser::divider;
  a.formats.drive = a.formats.state = a.formats.link = NumberFormat{16, 2, Rounding::trn_zero, Overflow::sat};
  return a;
}

/// `prescaled`: the host divides every row by its N, so the cell needs neither divider nor reciprocal.
inline ArraySpec prescaled_array() {
  ArraySpec a;
  a.name = "prescaled";
  a.normaliser = Normaliser::prescaled;
  a.formats.weight = a.formats.bias = NumberFormat{16, 1, Rounding::rnd, Overflow::sat};
  return a;
}

/// `byte`: eight bits everywhere: the smallest array that still moves, for exploring.
inline ArraySpec byte_array() {
  ArraySpec a;
  a.name = "byte";
  a.normaliser = Normaliser::divider;
  a.formats.weight = NumberFormat{8, 1, Rounding::rnd, Overflow::sat};
  a.formats.bias = NumberFormat{12, 5, Rounding::rnd, Overflow::sat};
  a.formats.drive = a.formats.state = a.formats.link = NumberFormat{8, 2, Rounding::trn_zero, Overflow::sat};
  return a;
}

/// `folded`: the bits of `guarded` on sixteen elements and one output stage, which an FPGA has room for.
inline ArraySpec folded_array() {
  ArraySpec a;
  a.name = "folded";
  a.elements = 16;
  a.stages = Stages::one;
  return a;
}

/// `descent-projected`: `descent` with over-relaxation: the energy can only fall (docs/hardware/datapath.md).
inline ArraySpec descent_projected_array() {
  ArraySpec a = descent_array();
  a.name = "descent-projected";
  a.output = Output::projected;
  return a;
}

/// `descent-momentum`: all neurons at once, and the energy can only fall, as the table's single entry is 0
/// with the driver's sequence.
inline ArraySpec descent_momentum_array() {
  ArraySpec a = descent_array();
  a.name = "descent-momentum";
  a.output = Output::momentum;
  a.schedule = Schedule::synchronous;
  a.momentum_entries = 1;
  return a;
}

inline std::vector<ArraySpec> presets() {
  return {guarded_array(), descent_array(),           prescaled_array(),       byte_array(),
          folded_array(),  descent_projected_array(), descent_momentum_array()};
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
