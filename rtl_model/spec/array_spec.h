// What the array IS, as data: number formats per signal class, schedule, lanes, normaliser, bus.
// Every option changes bits or cycles; docs/hardware/datapath.md says which bits, docs/hardware/cycles.md
// which cycles.
#pragma once

#include "rtl_model/spec/number_format.h"

#include <algorithm>
#include <string>
#include <vector>

namespace hopmesh::spec {

/// Who fires together: neurons of one colour; one neuron at a time; all at once (no proof of descent).
enum class Schedule : std::uint8_t { coloured, sequential, synchronous };
inline constexpr std::array<std::string_view, 3> schedule_names{"coloured", "sequential", "synchronous"};

/// How u = s / N is made: rows divided by N on the host; truncated reciprocal in the cell; exact divider.
enum class Normaliser : std::uint8_t { prescaled, reciprocal, divider };
inline constexpr std::array<std::string_view, 3> normaliser_names{"prescaled", "reciprocal", "divider"};

/// How V follows from s: a step toward the bound that s points to, by s / N; or that bound at once, sign(s).
enum class Output : std::uint8_t { modified, binary };
inline constexpr std::array<std::string_view, 2> output_names{"modified", "binary"};

inline std::string_view name_of(Schedule s) {
  return schedule_names[static_cast<std::size_t>(s)];
}
inline std::string_view name_of(Normaliser n) {
  return normaliser_names[static_cast<std::size_t>(n)];
}
inline std::string_view name_of(Output o) {
  return output_names[static_cast<std::size_t>(o)];
}

/// Number format of each class of signals. `bias` counts in units of weight (its point lies where it says).
/// `accumulator` is used only if !exact_accumulator; otherwise it is derived, wide enough for every sum.
struct Formats {
  NumberFormat weight{16, 1, Rounding::rnd, Overflow::sat};
  NumberFormat bias{24, 9, Rounding::rnd, Overflow::sat};
  NumberFormat accumulator{40, 12, Rounding::trn, Overflow::sat};
  NumberFormat drive{16, 2, Rounding::trn_zero, Overflow::sat}; ///< u = s / N
  NumberFormat state{16, 2, Rounding::trn_zero, Overflow::sat}; ///< V inside the output stage
  NumberFormat link{16, 2, Rounding::trn_zero, Overflow::sat};  ///< V as neighbours see it
};

struct ArraySpec {
  std::string name = "custom";
  Schedule schedule = Schedule::coloured;
  int lanes = 1; ///< multipliers per neuron: taps taken per cycle
  Output output = Output::modified;
  Normaliser normaliser = Normaliser::divider; ///< binary outputs need none, and none is looked at
  int reciprocal_bits = 18;                    ///< width of the reciprocal's mantissa (unsigned, truncated)
  bool exact_accumulator = true;
  int bus_bits = 32;        ///< data width of the host bus: 32, 64 or 128
  double clock_mhz = 100.0; ///< only for times in seconds; changes neither bits nor cycles
  Formats formats;
};

/// Is N summed in the cell? Not where the host divides by it, nor where only the sign of s counts.
inline bool sums_norm(const ArraySpec& a) {
  return a.output == Output::modified && a.normaliser != Normaliser::prescaled;
}

/// Is there a reciprocal of N in the cell?
inline bool has_reciprocal(const ArraySpec& a) {
  return a.output == Output::modified && a.normaliser == Normaliser::reciprocal;
}

/// Width that holds every sum of a row of `taps` products and its bias without loss
/// (docs/hardware/datapath.md). Its fraction is that of a product, or of the bias where that is finer.
inline NumberFormat exact_accumulator_format(const Formats& f, std::size_t taps) {
  const int product_fraction = f.weight.fraction_bits() + f.link.fraction_bits();
  const int fraction = std::max(product_fraction, f.bias.fraction_bits());
  const int product_integer =
      f.weight.integer_bits + 1; // |link| <= 1: the magnitude is a weight's, plus sign room
  int growth = 0;
  while ((std::size_t{1} << growth) < taps + 1) ++growth;
  const int integer = std::max(product_integer, f.bias.integer_bits) + growth;
  return NumberFormat{integer + fraction, integer, Rounding::trn, Overflow::wrap};
}

/// The accumulator's format as built for rows of at most `taps` inputs.
inline NumberFormat accumulator_format(const ArraySpec& a, std::size_t taps) {
  return a.exact_accumulator ? exact_accumulator_format(a.formats, taps) : a.formats.accumulator;
}

} // namespace hopmesh::spec
