// Mesh graph -> colours -> phases -> cycles. The order in which neurons fire and what it costs, as formulas.
// docs/hardware/cycles.md prints the same formulas; tests hold the SystemC array to them, to the cycle.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/colouring.h"

#include <algorithm>

namespace hopmesh::spec {

/// Neurons are numbered cell * neurons_per_cell + p. An entry is a phase: the neurons that fire in it,
/// ascending.
using Phases = std::vector<std::vector<std::uint32_t>>;

/// Phases of one sweep. Coloured: colour by colour, within a colour component by component.
/// Sequential: one neuron a phase, in number order. Synchronous: one phase.
inline Phases phases_of(const Topology& t, Schedule schedule) {
  const std::size_t per_cell = t.neurons_per_cell;
  Phases phases;
  if (t.cells() == 0) return phases;
  if (schedule == Schedule::synchronous) {
    phases.resize(1);
    for (std::size_t i = 0; i < t.neurons(); ++i) phases[0].push_back(i);
  } else if (schedule == Schedule::sequential) {
    for (std::size_t i = 0; i < t.neurons(); ++i) phases.push_back({std::uint32_t(i)});
  } else {
    const auto colour = colour_cells(t);
    phases.resize(per_cell * (1 + *std::max_element(colour.begin(), colour.end())));
    for (std::size_t c = 0; c < t.cells(); ++c)
      for (std::size_t p = 0; p < per_cell; ++p) phases[colour[c] * per_cell + p].push_back(c * per_cell + p);
  }
  return phases;
}

/// For each neuron, the phase in which it fires.
inline std::vector<std::size_t> phase_of_neurons(const Topology& t, const Phases& phases) {
  std::vector<std::size_t> phase(t.neurons());
  for (std::size_t k = 0; k < phases.size(); ++k)
    for (std::uint32_t neuron : phases[k]) phase[neuron] = k;
  return phase;
}

/// Cycle counts of an array built for a topology (docs/hardware/cycles.md).
struct CycleModel {
  std::uint64_t prepare = 0;        ///< once a run, after the start cycle: N of every row, and its reciprocal
  std::vector<std::uint64_t> phase; ///< accumulate + normalise + output, by the longest row that fires
  std::uint64_t sweep = 0;          ///< all phases and one cycle of the convergence detector

  /// From the cycle in which START is taken to the cycle in which DONE rises.
  std::uint64_t run(std::uint64_t sweeps) const { return 1 + prepare + sweeps * sweep; }
};

inline std::uint64_t accumulate_cycles(const ArraySpec& a, std::size_t taps) {
  return (taps + a.lanes - 1) / a.lanes;
}

/// Binary: the sign of s (1). Prescaled: round (1). Reciprocal: multiply, shift and round (2). Divider: one
/// quotient bit a cycle (fraction bits and the unit), then round.
inline std::uint64_t normalise_cycles(const ArraySpec& a) {
  if (!sums_norm(a)) return 1;
  if (a.normaliser == Normaliser::reciprocal) return 2;
  return a.formats.drive.fraction_bits() + 2;
}

/// R u (1; none where u is a sign), new V onto state and link (1).
inline std::uint64_t output_cycles(const ArraySpec& a) {
  return a.output == Output::binary ? 1 : 2;
}

inline CycleModel cycle_model(const ArraySpec& a, const Topology& t, const Phases& phases) {
  CycleModel m;
  if (sums_norm(a)) m.prepare = accumulate_cycles(a, t.most_taps());
  if (has_reciprocal(a)) m.prepare += a.reciprocal_bits + 1;
  for (const auto& neurons : phases) {
    std::size_t taps = 0;
    for (std::uint32_t i : neurons) taps = std::max(taps, t.taps(i / t.neurons_per_cell));
    m.phase.push_back(accumulate_cycles(a, taps) + normalise_cycles(a) + output_cycles(a));
    m.sweep += m.phase.back();
  }
  m.sweep += 1;
  return m;
}

/// A run walks through segments, which waves show by number: first_phase + k is phase k of a sweep.
struct Segment {
  enum Number : int { idle, start, prepare, check, first_phase };
};

inline std::uint64_t segment_cycles(const CycleModel& m, int segment) {
  switch (segment) {
  case Segment::idle:
    return 0;
  case Segment::start:
  case Segment::check:
    return 1;
  case Segment::prepare:
    return m.prepare;
  default:
    return m.phase[static_cast<std::size_t>(segment - Segment::first_phase)];
  }
}

/// The segment that follows: START is taken, N is prepared where the array sums it, then sweep after sweep of
/// all phases and a check, until a check finds the run to be over.
inline int next_segment(const CycleModel& m, int segment, bool over) {
  const int phases_end = Segment::first_phase + static_cast<int>(m.phase.size());
  if (segment == Segment::idle) return Segment::start;
  if (segment == Segment::start && m.prepare > 0) return Segment::prepare;
  if (segment == Segment::check && over) return Segment::idle;
  const int next = segment < Segment::first_phase ? +Segment::first_phase : segment + 1;
  return next < phases_end ? next : +Segment::check;
}

/// Cycles that a transfer of `words` 32-bit words holds the bus: one for the address, then the data beats.
inline std::uint64_t bus_cycles(const ArraySpec& a, std::uint64_t words) {
  return 1 + (words * 32 + a.bus_bits - 1) / a.bus_bits;
}

} // namespace hopmesh::spec
