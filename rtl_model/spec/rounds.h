// How neurons share the elements of a folded array: in which order, round by round, and in which cycle of a
// phase each is summed and shows its new V. docs/hardware/cycles.md, "Folded arrays", has the same rules.
#pragma once

#include "rtl_model/spec/schedule.h"
#include "rtl_model/spec/stage_cycles.h"

#include <utility>

namespace hopmesh::spec {

/// Neurons that are summed together, one an element. Element e has the one at `first` + e of the phase's
/// order. Cycles are counted from 0, which reads the memories: of the phase, or of prepare.
struct Round {
  std::size_t phase = 0, first = 0, count = 0;
  std::uint64_t begins = 0;     ///< the cycle that adds the first group of taps
  std::uint64_t accumulate = 0; ///< cycles that the longest row takes
  std::uint64_t leaves = 0;     ///< the cycle at whose end the sums leave the accumulators

  bool adds(std::uint64_t cycle) const { return cycle >= begins && cycle < begins + accumulate; }
};
using Rounds = std::vector<Round>;

/// Neurons of a phase in the order in which elements take them: longest rows first.
inline std::vector<std::uint32_t> folded_order(const Topology& t, std::vector<std::uint32_t> phase) {
  const auto taps = [&t](std::uint32_t neuron) { return t.taps(neuron / t.neurons_per_cell); };
  std::stable_sort(phase.begin(), phase.end(),
                   [&taps](std::uint32_t a, std::uint32_t b) { return taps(a) > taps(b); });
  return phase;
}

namespace detail {

/// `order`: of phase number `phase`. Appends its rounds, without their times.
inline void append_rounds(const ArraySpec& a, const Topology& t, const std::vector<std::uint32_t>& order,
                          std::size_t phase, Rounds& rounds) {
  const auto elements = static_cast<std::size_t>(a.elements);
  for (std::size_t first = 0; first < order.size(); first += elements) {
    const std::size_t taps = t.taps(order[first] / t.neurons_per_cell);
    const std::size_t count = std::min(elements, order.size() - first);
    rounds.push_back({phase, first, count, 0, accumulate_cycles(a, taps), 0});
  }
}

/// Where stages are shared, the sums of a round wait until those of the round before have gone into the stage
/// one by one; else until the stages, `depth` cycles long, are free.
inline void time_rounds(const ArraySpec& a, std::uint64_t depth, Rounds& rounds) {
  std::uint64_t left = 0, busy = 0;
  for (Round& r : rounds) {
    r.begins = left + 1;
    left += std::max(r.accumulate, busy);
    r.leaves = left;
    busy = shares_stage(a) ? r.count : depth;
  }
}

} // namespace detail

/// The cycle at whose end the neuron of an element has gone through `depth` cycles of its stage.
inline std::uint64_t through_stage(const ArraySpec& a, const Round& round, std::size_t element,
                                   std::uint64_t depth) {
  return round.leaves + (shares_stage(a) ? element : 0) + depth;
}

/// Cycles of rounds that end when the last of their neurons has gone through `depth` cycles.
inline std::uint64_t cycles_of(const ArraySpec& a, const Rounds& rounds, std::uint64_t depth) {
  return 1 + through_stage(a, rounds.back(), rounds.back().count - 1, depth);
}

/// What a folded array does in a sweep, and before the first one.
struct Fold {
  Phases order;               ///< of each phase
  std::vector<Rounds> rounds; ///< of each phase
  Rounds prepare;             ///< of all phases one behind the other; empty where nothing is prepared
  /// Cycles from the last of N until N, or its reciprocal, is in its memory.
  std::uint64_t prepare_depth = 0;
};

/// Order, rounds and times of a folded array; `a.elements` must be above 0.
inline Fold fold_of(const ArraySpec& a, const Topology& t, const Phases& phases) {
  Fold fold;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    fold.order.push_back(folded_order(t, phases[k]));
    fold.rounds.emplace_back();
    detail::append_rounds(a, t, fold.order[k], k, fold.rounds[k]);
    fold.prepare.insert(fold.prepare.end(), fold.rounds[k].begin(), fold.rounds[k].end());
    detail::time_rounds(a, stage_cycles(a), fold.rounds[k]);
  }
  if (!sums_norm(a)) fold.prepare.clear();
  fold.prepare_depth = has_reciprocal(a) ? reciprocal_cycles(a) : shares_stage(a) ? 1 : 0;
  detail::time_rounds(a, fold.prepare_depth, fold.prepare);
  return fold;
}

} // namespace hopmesh::spec
