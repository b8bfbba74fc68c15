// The steps of a scene as the array flies them, each beside the same step solved exactly, and how early a
// rival may stop to be as far from it: what a comparison of times at equal answers stands on.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/rivals/integrator.h"

#include <string>
#include <vector>

namespace hopmesh::bench {

/// What an array of a motion takes for a step, s.
struct ArrayTime {
  double array = 0, bus = 0; ///< on hardware, at the array's clock
  double emulation = 0;      ///< of processor time, at the default level
  double sweeps = 0;         ///< not s: how many

  double hardware() const { return array + bus; }
};
/// Over at most so many steps of a shipped scene.
ArrayTime array_time(const std::string& scene, const std::vector<std::string>& overrides,
                     std::size_t most_steps);

/// A step error is the root mean square distance of nodes, over all steps, from the same steps solved exactly
/// from the same starts, m.
class EqualSteps {
 public:
  /// Flies at most so many steps of a shipped scene.
  EqualSteps(const std::string& scene, const std::vector<std::string>& overrides, std::size_t most_steps);

  std::size_t count() const { return starts_.size(); }
  double array_error() const { return array_error_; }
  const ArrayTime& array() const { return array_; }

  std::unique_ptr<rivals::Method> make(const std::string& method, double tolerance) const;
  /// Puts the method at the start of a step.
  void place(rivals::Method& method, std::size_t step) const;
  double error(const std::string& method, double tolerance) const;
  /// The widest tolerance, m, whose error is at most the array's, to within a quarter of a percent; 0 where
  /// none is.
  double equal_tolerance(const std::string& method) const;

 private:
  levels::Prepared prepared_;
  rivals::Physics physics_;
  std::vector<rivals::State> starts_; ///< [steps]
  std::vector<rivals::Vector> ends_;  ///< [steps] solved exactly, [3 * nodes] node by node
  ArrayTime array_;
  double array_error_ = 0;
};

} // namespace hopmesh::bench
