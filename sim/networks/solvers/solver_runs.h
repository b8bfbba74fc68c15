// All solvers on one problem: sweeps and processor time to stated energy gaps, and what went wrong.
#pragma once

#include "sim/networks/solvers/answer.h"
#include "sim/networks/solvers/network_solver.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace hopmesh::solvers {

struct Limits {
  std::vector<double> gaps; ///< relative to the start's, falling
  std::uint64_t max_sweeps = 0;
  bool to_rest = false; ///< on beyond the last gap, until it stalls: at rest, or no lower for as long again
  std::vector<std::string> only = {}; ///< methods that run; empty: all
};

/// When a gap was first reached. Seconds are the thread's processor time, preparation included, gaps' own
/// cost not.
struct Reached {
  std::uint64_t sweeps = 0;
  double seconds = 0;
  std::optional<HardwareWork> hardware = {};
};

struct Sample {
  std::uint64_t sweep;
  double gap; ///< relative to the start's
  double seconds = 0;
  std::optional<HardwareWork> hardware = {};
};

struct SolverRun {
  std::string name;
  std::vector<std::optional<Reached>> reached; ///< one a gap of the limits
  std::uint64_t sweeps = 0, rises = 0;         ///< done; in how many of them the energy rose
  std::uint64_t factorisations = 0;
  double seconds = 0;
  std::string failure;           ///< a sentence; "" where every gap was reached
  std::vector<Sample> samples;   ///< for a chart: ever sparser
  Vector lowest;                 ///< of the least energy met
  double least_gap = 1;          ///< there, relative
  std::uint64_t least_sweep = 0; ///< when it was first met
};

/// Runs a solver until the last gap, a cycle, a rest, max_sweeps or `stop`.
SolverRun run_solver(const std::string& name, const Problem& problem, const Answer& answer,
                     const Limits& limits, const std::atomic<bool>& stop);

/// Runs a solver of somebody else's likewise; `make` counts as its preparation.
using MakeSolver = std::function<std::unique_ptr<Solver>()>;
SolverRun run_solver(const std::string& name, const MakeSolver& make, const Problem& problem,
                     const Answer& answer, const Limits& limits, const std::atomic<bool>& stop);

inline bool runs(const Limits& limits, const std::string& name) {
  return limits.only.empty() || std::count(limits.only.begin(), limits.only.end(), name) > 0;
}

struct SolverRuns {
  Answer answer;
  std::vector<SolverRun> runs;
};

/// All of solver_names() that the limits let run; none where the start is the answer. Where the energy is not
/// convex, against the lowest that any of them found.
SolverRuns solve_with_all(const Problem& problem, const Limits& limits, const std::atomic<bool>& stop);

} // namespace hopmesh::solvers
