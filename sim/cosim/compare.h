// Levels beside each other: are bits and cycles equal, how far is each from the reference, where do they
// first part?
#pragma once

#include "sim/cosim/explain.h"
#include "sim/levels/level.h"
#include "sim/run/simulation.h"

namespace hopmesh::cosim {

/// Distance between the free motions of a level and of the reference after so many steps.
struct Distance {
  std::uint64_t steps = 0;
  double rms = 0, largest = 0; ///< m
};

struct LevelReport {
  std::string level;
  std::vector<levels::StepRow> rows;
  std::vector<Distance> distances; ///< empty without a reference, and for the reference itself
};

struct Difference {
  std::string level[2];
  std::string waving; ///< the one of them that a wave is cut of; "" where neither can
  std::uint64_t step = 0;
  std::uint64_t sweeps[2] = {0, 0}, cycles[2] = {0, 0};
  /// Cycles of all runs before the one that differs (the step's last expansion), as waves count them.
  std::uint64_t cycles_before = 0;
  std::optional<FirstDifference> where; ///< none: equal outputs, unequal sweeps or cycles
  std::string memory;                   ///< the word in which the loaded networks differ; mostly none
};

struct Comparison {
  run::Outcome outcome = run::Outcome::finished;
  std::string sentence;
  std::uint64_t steps = 0;
  std::vector<LevelReport> levels;
  std::size_t pairs = 0;                ///< pairs of fixed levels compared, every code after every sweep
  std::uint64_t sweeps_compared = 0;    ///< after which all fixed levels were equal
  std::optional<Difference> difference; ///< the first; nothing after it was compared
};

/// Advances all levels together; a reference must come first. After each step the fixed levels relax its
/// network once more, in lockstep, and are compared after every sweep (with several expansions: that of the
/// last one). `after_step` is told the number of steps done.
Comparison compare(const std::vector<levels::ReadyLevel>& ready, const levels::BuiltMesh& mesh,
                   const spec::ArraySpec& array, std::uint64_t steps,
                   const std::function<void(const levels::StepRow&)>& after_step,
                   const std::atomic<bool>& stop);

/// The comparison for people, a few lines. `inputs`: SCENE and options as a command line has them, for the
/// command that cuts a wave around a difference.
std::string text_of(const Comparison& comparison, const std::string& inputs, const spec::ArraySpec& array);

} // namespace hopmesh::cosim
