// One point of a study: its settings in, one row of results out. The one place where methods plug in.
#pragma once

#include "sim/run/snapshots.h"
#include "sim/scene/scene_file.h"
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

/// The exact motion at a few times, and how far it is known; empty where nobody knows it.
struct Truth {
  std::vector<std::vector<double>> positions; ///< [times] each [nodes * 3], m
  std::vector<double> floor;                  ///< [times] rms that two exact solutions differ by, m
};

/// The methods a study may name, given by whoever can see them all. A method is a Motion: levels of the
/// array, the reference, and integrators alike.
struct Methods {
  std::vector<std::string> names;
  /// Asks the reference beside every step, where the method can.
  std::function<std::shared_ptr<levels::Motion>(const std::string& method, const scene::Inputs& inputs)> make;
  std::function<Truth(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
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
  Maybe output_error;                        ///< rms over all steps and neurons
  Maybe output_error_median;                 ///< median over steps of the rms over neurons
  Maybe position_error;                      ///< rms at the end, of the free motions, m
  std::vector<Maybe> reference_at, truth_at; ///< rms of positions at the stated times, m
  std::vector<Maybe> floor_at;               ///< below which truth_at means nothing
  std::string sentence;
};

/// Runs it here and now, and the reference beside it; positions are compared at the `times`, s. Throws only
/// what is a defect; a point that diverges is a row.
PointRow run_point(const Point& point, const scene::Inputs& inputs, const std::vector<double>& times,
                   const Methods& methods, const std::atomic<bool>& stop);

} // namespace hopmesh::study
