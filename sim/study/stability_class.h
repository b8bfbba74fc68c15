// What became of a motion, in one word: a pure function of its rows.
#pragma once

#include "sim/levels/mover.h"

namespace hopmesh::study {

enum class Stability {
  stable,
  blow_up,       ///< diverged: no finite position, or a spring beyond most_stretch
  energy_gain,   ///< the energy of the last quarter is a multiple of that of the third
  limit_cycle,   ///< outputs that mostly swing between two states and never come to rest
  saturated,     ///< most outputs stand at +1 or -1
  lattice_stall, ///< at rest for its own words, with most of the fall left
  falsely_soft,  ///< much of the fall left, whatever ended the steps: springs give way that should not
  over_damped    ///< the motion died, faster than friction explains
};

/// In the order in which they are asked: the first that holds names the run.
inline constexpr const char* stability_names[] = {"stable",       "blow-up",    "energy gain",
                                                  "limit cycle",  "saturated",  "lattice stall",
                                                  "falsely soft", "over-damped"};
inline constexpr std::size_t stability_count = 8;
inline const char* name_of(Stability s) {
  return stability_names[static_cast<std::size_t>(s)];
}

/// Borders between classes; docs/use/study-files.md prints them.
inline constexpr double gain_factor = 3;     ///< of energy, from the third quarter of the steps to the last
inline constexpr double most_of = 0.5;       ///< a share above this is "mostly"
inline constexpr double stall_share = 0.9;   ///< of a step's fall, left by one that came to rest
inline constexpr double soft_share = 0.5;    ///< of a step's fall, left by any
inline constexpr double damped_share = 1e-3; ///< of the largest kinetic energy that friction would leave
inline constexpr double cycle_share = 0.5;   ///< of a swing that is still there after 20 sweeps
inline constexpr std::size_t least_rows = 8; ///< fewer say nothing of energy

/// What the rows do not tell.
struct StabilityFacts {
  bool diverged = false;
  std::size_t outputs = 1;
  double friction = 1; ///< what it leaves of a velocity from a row to the next
};

Stability classify(const std::vector<levels::StepRow>& rows, const StabilityFacts& facts);

} // namespace hopmesh::study
