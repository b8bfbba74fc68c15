// A point of a study: its settings in, a row of results out. This is the one place where methods plug in.
#pragma once

#include "sim/levels/exact_motion.h"
#include "sim/run/snapshots.h"
#include "sim/scene/scene_file.h"
#include "sim/study/point_row.h"

#include <functional>

namespace hopmesh::study {

using Truth = levels::ExactMotion;

/// The reference's own motion of a scene, at a few times and in the end; empty where it did not come so far.
struct FreeMotion {
  std::vector<run::Positions> at; ///< [times]
  run::Positions last;
};

/// The methods a study may name, given by whoever can see them all. A method is a Mover: levels of the
/// array, the reference, and integrators alike.
struct Methods {
  std::vector<std::string> names;
  /// Asks the reference beside every step, where the method can.
  std::function<std::shared_ptr<levels::Mover>(const std::string& method, const scene::Inputs& inputs)> make;
  std::function<Truth(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                      const std::vector<double>& times)>
      truth;
  /// After so many steps.
  std::function<FreeMotion(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                           const std::vector<double>& times, std::uint64_t steps,
                           const std::atomic<bool>& stop)>
      reference;
  /// Rms at each of the times that two references differ by which start a last place apart, m.
  std::function<std::vector<Maybe>(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                   const std::vector<double>& times)>
      sensitivity;
};

/// Runs it here and now; positions are compared at the `times`, s. Throws only
/// what is a defect; a point that diverges is a row.
PointRow run_point(const Point& point, const scene::Inputs& inputs, const std::vector<double>& times,
                   const Methods& methods, const std::atomic<bool>& stop);

} // namespace hopmesh::study
