// Where two answers to one job part: sweep, phase, cycle, neuron, and what that neuron had read.
#pragma once

#include "rtl_model/spec/cycles.h"
#include "sim/cosim/loaded_job.h"

#include <optional>

namespace hopmesh::cosim {

/// When a job's neurons fire.
struct Timing {
  explicit Timing(const ArrayJob& job);
  /// Cycle of the run in which a phase of a sweep (from 1) publishes the last of its outputs; the run's cycle
  /// 0 takes START.
  std::uint64_t published(std::uint64_t sweep, std::size_t phase) const;
  /// Of all neurons of a phase, in the order in which they publish: the neuron, and its cycle of the run.
  std::vector<std::pair<std::uint32_t, std::uint64_t>> publications(std::uint64_t sweep,
                                                                    std::size_t phase) const;

  spec::Phases phases;
  spec::CycleModel cycles;

 private:
  const spec::ArraySpec array_;
  std::optional<spec::Fold> fold_; ///< of a folded array
};

/// An input of a neuron: where it comes from, its weight, and the source's V one update earlier.
struct Tap {
  std::uint32_t cell, component;
  std::int32_t weight_raw, output_raw;
};

struct Divergence {
  std::uint64_t sweep = 0; ///< from 1
  std::size_t phase = 0;
  std::uint64_t cycle = 0; ///< of the run, in which the neuron published
  std::uint32_t neuron = 0;
  std::int32_t raw[2] = {0, 0}; ///< V after it, in either answer
  std::int32_t before_raw = 0, bias_raw = 0;
  std::vector<Tap> taps;
  bool ahead = false; ///< links carry Y, which stands ahead of V and in no register
};

/// Behind the words about inputs, for people.
inline const char* ahead_note(bool ahead) {
  return ahead ? " (V; links carried Y, which lies ahead of it)" : "";
}

/// Of the neurons whose outputs differ after a sweep that began from `before`, the one that fired first.
Divergence locate(const ArrayJob& job, std::uint64_t sweep, const Codes& before, const Codes& a,
                  const Codes& b);

} // namespace hopmesh::cosim
