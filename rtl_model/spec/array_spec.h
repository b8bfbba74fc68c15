// What the array IS, as data: number formats per signal class, schedule, lanes, normaliser, bus.
// Every option changes bits or cycles; docs/hardware/datapath.md says which bits, docs/hardware/cycles.md
// which cycles.
#pragma once

#include "rtl_model/spec/array_modes.h"
#include "rtl_model/spec/number_format.h"

#include <algorithm>
#include <string>
#include <vector>

namespace hopmesh::spec {

/// Number format of each class of signals: those of the preset `guarded`.
struct Formats {
  /// A weight of a row.
  NumberFormat weight{16, 1, Rounding::rnd, Overflow::sat};
  /// External input of a neuron, in units of weight: its point lies where its own format says.
  NumberFormat bias{24, 9, Rounding::rnd, Overflow::sat};
  /// The sum s. Looked at only if !exact_accumulator; otherwise it is derived, wide enough for every sum.
  NumberFormat accumulator{40, 12, Rounding::trn, Overflow::sat};
  /// u = s / N, or the sign of s.
  NumberFormat drive{18, 2, Rounding::rnd, Overflow::sat};
  /// V inside the output stage, and on the bus; with more places than the link has, small steps add up.
  NumberFormat state{24, 2, Rounding::rnd, Overflow::sat};
  /// V as neighbours, and the neuron itself, see it.
  NumberFormat link{16, 2, Rounding::rnd, Overflow::sat};
};

/// A class of signals: its name in keys, where its format stands, what it holds, and the integer bits that it
/// cannot do without (two where +1 must have a code).
struct SignalClass {
  const char* name;
  NumberFormat Formats::*format;
  const char* meaning;
  int least_integer_bits;
};
inline constexpr std::array<SignalClass, 6> signal_classes{{
    {"weight", &Formats::weight, "a weight as the host writes it", 1},
    {"bias", &Formats::bias, "a bias as the host writes it", 1},
    {"accumulator", &Formats::accumulator, "the register of s; `\"exact\"`: as wide as the longest row needs",
     1},
    {"drive", &Formats::drive, "u", 2},
    {"state", &Formats::state, "V in the output stage", 2},
    {"link", &Formats::link, "V as neighbours see it, no finer than the state", 2},
}};

/// An array that nobody changed is the preset `guarded`, the default (docs/decisions/0002-default-array.md).
struct ArraySpec {
  /// What reports call it.
  std::string name = "guarded";
  /// Which neurons fire together: decides bits (who reads new values) and cycles (phases of a sweep).
  Schedule schedule = Schedule::coloured;
  /// Multipliers of an element, or of a neuron where each has its own: taps of a row taken per cycle. Changes
  /// bits only if the accumulator rounds.
  int lanes = 1;
  /// Processing elements that the neurons of a phase share, round by round (rounds.h); 0: one a neuron.
  /// Changes cycles, never bits.
  int elements = 0;
  /// Output stages of those elements; not looked at where elements is 0.
  Stages stages = Stages::each;
  /// Registers inside normalise and output beyond those of the page: each makes a stage a cycle longer.
  int pipeline = 0;
  /// How V follows from s.
  Output output = Output::modified;
  /// How s / N is made; a binary output has none, and this is not looked at.
  Normaliser normaliser = Normaliser::reciprocal;
  /// Width of the reciprocal's mantissa, unsigned and truncated; looked at only with that normaliser.
  int reciprocal_bits = 18;
  /// The accumulator holds every place of every sum; otherwise formats.accumulator, rounded once a cycle.
  bool exact_accumulator = true;
  /// omega in sixteenths; looked at only with `projected`.
  int relaxation = 29;
  /// Entries of the table of m; looked at only with `momentum`.
  int momentum_entries = 256;
  /// Data width of the host bus: 32, 64 or 128. Changes only the cycles that transfers hold it.
  int bus_bits = 32;
  /// Codes of half a word and less share words of the host bus. Changes only the cycles that transfers hold
  /// it.
  bool packing = false;
  /// Only for times in seconds; changes neither bits nor cycles.
  double clock_mhz = 100.0;
  Formats formats;
};

/// Is s divided at all, by the cell or by the host? Not where only its sign counts.
inline bool divides(const ArraySpec& a) {
  return a.output != Output::binary;
}

/// Is what divides s made in the cell? Not where the host divides.
inline bool sums_norm(const ArraySpec& a) {
  return divides(a) && a.normaliser != Normaliser::prescaled;
}

/// Is there a reciprocal of it in the cell?
inline bool has_reciprocal(const ArraySpec& a) {
  return divides(a) && a.normaliser == Normaliser::reciprocal;
}

/// Do links carry Y, a point ahead of V, and is there a table of m?
inline bool has_momentum(const ArraySpec& a) {
  return a.output == Output::momentum;
}

/// Do neurons share elements?
inline bool is_folded(const ArraySpec& a) {
  return a.elements > 0;
}

/// Is there a single output stage for all elements?
inline bool shares_stage(const ArraySpec& a) {
  return is_folded(a) && a.stages == Stages::one;
}

/// Places for registers inside normalise and output (docs/hardware/cycles.md, "Registers inside a stage").
inline int most_pipeline(const ArraySpec& a) {
  if (a.output == Output::binary) return 0;
  if (a.output == Output::projected) return 2;
  if (a.output == Output::momentum) return 3;
  return a.normaliser == Normaliser::prescaled ? 3 : 4;
}

/// The least format that holds every sum of a row of `taps` products and its bias without loss
/// (docs/hardware/datapath.md). Its fraction is that of a product, or of the bias where that is finer.
inline NumberFormat exact_accumulator_format(const Formats& f, std::size_t taps) {
  const int fraction = std::max(f.weight.fraction_bits() + f.link.fraction_bits(), f.bias.fraction_bits());
  // A sum lies within taps * 2^(integer bits - 1) of weights, as |link| <= 1, and 2^(integer bits - 1) of
  // bias.
  const std::uint64_t bound =
      (static_cast<std::uint64_t>(taps) << (f.weight.integer_bits - 1)) + (1u << (f.bias.integer_bits - 1));
  int integer = 1; // the sign
  while (bound >> (integer - 1) != 0) ++integer;
  return NumberFormat{integer + fraction, integer, Rounding::trn, Overflow::wrap};
}

/// The accumulator's format as built for rows of at most `taps` inputs.
inline NumberFormat accumulator_format(const ArraySpec& a, std::size_t taps) {
  return a.exact_accumulator ? exact_accumulator_format(a.formats, taps) : a.formats.accumulator;
}

/// All formats as built for rows of at most `taps` inputs: those of the array, with that accumulator.
inline Formats built_formats(const ArraySpec& a, std::size_t taps) {
  Formats f = a.formats;
  f.accumulator = accumulator_format(a, taps);
  return f;
}

} // namespace hopmesh::spec
