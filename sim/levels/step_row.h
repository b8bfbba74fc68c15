// What a step leaves behind: a row of steps.csv. Its columns are told in sim/levels/step_columns.h.
#pragma once

#include <cstdint>
#include <optional>

namespace hopmesh::levels {

/// How the array's answer to a step differs from the double reference's answer to the same step (same
/// positions, velocities and start): V against its rest, and against where it is after the same sweeps.
struct ReferenceError {
  double largest_output = 0, rms_output = 0; ///< |V - V_rest|
  double rounding = 0, stopping = 0;         ///< rms of |V - V_same sweeps|, |V_same sweeps - V_rest|
  /// (E(V) - E(V_rest)) / (E(V0) - E(V_rest)), of the network's energy; 0 where nothing falls.
  double energy_gap = 0;
  double network = 0;
  double alternation = 0; ///< of a step that did not come to rest: as in StepRow
  double fall_left = 0;   ///< as in StepRow
  std::optional<double> host = {};
};

struct StepRow {
  std::uint64_t step = 0;
  double time = 0;
  std::uint64_t sweeps = 0, cycles = 0;
  double energy = 0, kinetic = 0, max_strain = 0, max_stretch = 0;
  std::uint64_t saturated = 0;
  bool converged = false;
  /// Of a step that did not converge: 1 where outputs swing between two states for ever.
  double alternation = 0;
  double input_left = 0;                      ///< see sim/levels/left_over.h
  std::uint64_t refinements = 0, refused = 0; ///< corrections that were kept, and that were not
  std::optional<double> residual;             ///< where corrections were asked for
  std::optional<double> fall_left;            ///< where the reference was asked or answers itself
  std::optional<double> fall_seen;            ///< of it, so much at least: LeftOver
  std::optional<double> told_error;           ///< rms of V - V_rest without a rest: networks/told_error.h
  std::optional<double> error_bound;          ///< beforehand: networks/error_bound.h
  std::uint64_t bus_cycles = 0, clipped = 0, vanished = 0;
  std::optional<double> instructions;  ///< of the host, where they are counted
  std::optional<double> host_error;    ///< where the reference was asked about whole numbers
  std::optional<ReferenceError> error; ///< where the reference was asked
  std::uint64_t hash = 0;
};

} // namespace hopmesh::levels
