// Phases -> cycles: what a run costs, as formulas. docs/hardware/cycles.md prints the same formulas; tests
// hold the SystemC array to them, to the cycle.
#pragma once

#include "rtl_model/spec/rounds.h"

namespace hopmesh::spec {

/// Cycle counts of an array built for a topology (docs/hardware/cycles.md).
struct CycleModel {
  std::uint64_t prepare = 0;        ///< once a run, after the start cycle: N of every row, and its reciprocal
  std::vector<std::uint64_t> phase; ///< accumulate + normalise + output, by the longest rows that fire
  std::uint64_t sweep = 0;          ///< all phases and one cycle of the convergence detector

  /// From the cycle in which START is taken to the cycle in which DONE rises.
  std::uint64_t run(std::uint64_t sweeps) const { return 1 + prepare + sweeps * sweep; }
};

namespace detail {

inline CycleModel unfolded_cycles(const ArraySpec& a, const Topology& t, const Phases& phases) {
  CycleModel m;
  if (sums_norm(a)) m.prepare = accumulate_cycles(a, t.most_taps()) + reciprocal_cycles(a);
  for (const auto& neurons : phases) {
    std::size_t taps = 0;
    for (std::uint32_t i : neurons) taps = std::max(taps, t.taps(i / t.neurons_per_cell));
    m.phase.push_back(accumulate_cycles(a, taps) + stage_cycles(a));
  }
  return m;
}

inline CycleModel folded_cycles(const ArraySpec& a, const Fold& fold) {
  CycleModel m;
  if (!fold.prepare.empty()) m.prepare = cycles_of(a, fold.prepare, fold.prepare_depth);
  for (const Rounds& rounds : fold.rounds) m.phase.push_back(cycles_of(a, rounds, stage_cycles(a)));
  return m;
}

} // namespace detail

inline CycleModel cycle_model(const ArraySpec& a, const Topology& t, const Phases& phases) {
  CycleModel m =
      is_folded(a) ? detail::folded_cycles(a, fold_of(a, t, phases)) : detail::unfolded_cycles(a, t, phases);
  m.sweep = std::accumulate(m.phase.begin(), m.phase.end(), std::uint64_t{1});
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

/// A RESET empties a line of every memory each cycle, so it takes as long as the deepest memory has lines. A
/// row has a line for each group of its lanes. Of a folded array, the first element has the most rows, and
/// the longest of each round; links and states have a line a neuron. A table of m has a line an entry.
inline std::uint64_t reset_cycles(const ArraySpec& a, const Topology& t) {
  const std::uint64_t table = has_momentum(a) ? static_cast<std::uint64_t>(a.momentum_entries) : 1;
  if (!is_folded(a)) return std::max(table, accumulate_cycles(a, t.most_taps()));
  std::uint64_t lines = 0;
  for (const Rounds& rounds : fold_of(a, t, phases_of(t, a.schedule)).rounds)
    for (const Round& round : rounds) lines += round.accumulate;
  return std::max({lines, static_cast<std::uint64_t>(t.neurons()), table});
}

/// Cycles that a transfer of `words` 32-bit words holds the bus: one for the address, then the data beats.
inline std::uint64_t bus_cycles(const ArraySpec& a, std::uint64_t words) {
  return 1 + (words * 32 + a.bus_bits - 1) / a.bus_bits;
}

} // namespace hopmesh::spec
