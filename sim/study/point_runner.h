// One point of a study: its settings in, one row of results out. The one place where methods plug in.
#pragma once

#include "sim/scene/scene_file.h"
#include "sim/study/simulation.h"
#include "sim/study/stability_class.h"

#include <functional>

namespace hopmesh::study {

/// A combination of the axes' places, with everything that runs it.
struct Point {
  std::size_t number = 0; ///< in the study, from 0
  std::string method;
  std::vector<std::string> labels; ///< one an axis
  std::vector<std::string> overrides;
  std::string command; ///< that repeats the point
};

/// The methods a study may name, given by whoever can see them all. A method is a Motion: levels of the
/// array, the reference, and integrators alike.
struct Methods {
  std::vector<std::string> names;
  /// `check`: ask the reference beside every step, where the method can.
  std::function<std::shared_ptr<Motion>(const std::string& method, const scene::Inputs& inputs,
                                        const BuiltMesh& mesh, bool check)>
      make;
  /// Positions [nodes * 3] of the exact motion at each of the times; empty function: nobody knows it.
  std::function<std::vector<std::vector<double>>(const scene::Inputs& inputs, const BuiltMesh& mesh,
                                                 const std::vector<double>& times)>
      truth;
};

using Maybe = std::optional<double>;

struct PointRow {
  std::string status; ///< finished, diverged, crashed, or failed: and why, in `sentence`
  Stability stability = Stability::stable;
  std::uint64_t steps = 0, sweeps = 0, cycles = 0, bus_cycles = 0, memory_bits = 0;
  std::uint64_t multiplies = 0; ///< of all sweeps
  double array_seconds = 0, host_seconds = 0, largest_strain = 0;
  double omega = 0;                          ///< 1/s, of the stiffest wave of the mesh at the start
  Maybe output_error, position_error;        ///< rms; the latter in m, at the end, of the free motions
  std::vector<Maybe> reference_at, truth_at; ///< rms of positions at the stated times, m
  std::string sentence;
};

/// What a study asks of every point beside its settings.
struct PointAsk {
  std::vector<double> times;
  bool reference = true; ///< fly the reference beside it (the check of every step is asked anyway)
};

/// Runs it here and now. Throws only what is a defect; a point that diverges is a row.
PointRow run_point(const Point& point, const scene::Inputs& inputs, const PointAsk& ask,
                   const Methods& methods, const std::atomic<bool>& stop);

/// The step at whose end a time is taken: the nearest, 1-based.
std::uint64_t step_of_time(double time, double time_step);

} // namespace hopmesh::study
