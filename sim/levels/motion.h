// A motion that can be advanced step by step: the study's view of a level. Nobody above can tell which one it
// is.
#pragma once

#include "sim/levels/array_port.h"
#include "sim/levels/built_mesh.h"
#include "sim/levels/bus_error.h"
#include "sim/levels/step_state.h"

#include <optional>
#include <stdexcept>

namespace hopmesh::levels {

/// How the array's answer to a step differs from the double reference's answer to the same step (same
/// positions, velocities and start). The reference relaxes to the same threshold, in the same order.
struct ReferenceError {
  double largest_output = 0; ///< max |V - V_reference|
  double rms_output = 0;
  double energy_gap =
      0; ///< (E(V) - E(V_ref)) / (E(V0) - E(V_ref)), of the network's energy; 0 where nothing falls
  double network = 0;     ///< largest difference of a weight or bias, over the largest of them
  double alternation = 0; ///< of a step that did not come to rest: as in StepRow
};

/// One row of steps.csv.
struct StepRow {
  std::uint64_t step = 0; ///< 0-based
  double time = 0;        ///< s, at the step's end
  std::uint64_t sweeps = 0, cycles = 0;
  double energy = 0;           ///< of the springs: sum alpha (|x_i - x_j| - L)^2, or their law's
  double kinetic = 0;          ///< sum 1/2 m v^2, J
  double max_strain = 0;       ///< largest | length / rest length - 1 |
  double max_stretch = 0;      ///< largest length / rest length (initial length where L = 0)
  std::uint64_t saturated = 0; ///< outputs at rest at +1 or -1
  bool converged = false;
  double alternation = 0; ///< of a step that did not: 1 where outputs swing between two states for ever
  std::uint64_t bus_cycles = 0, clipped = 0;
  std::optional<ReferenceError> error;
  std::uint64_t hash = 0; ///< of positions, velocities, accelerations and V
};

/// The step had no finite answer; what() says in a sentence what was found.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Motion {
 public:
  virtual ~Motion() = default;
  /// Does the next step. Throws Diverged or Stopped with the state of the last good step kept.
  virtual StepRow advance() = 0;
  virtual const std::vector<double>& positions() const = 0; ///< [nodes * 3]
  /// V at rest as raw codes, [nodes * components]; empty at levels without codes.
  virtual std::vector<std::int32_t> outputs_raw() const { return {}; }
  virtual std::vector<SignalRange> ranges() const { return {}; }
  /// Seconds that went into judging the steps, not into making them.
  virtual double judging_seconds() const { return 0; }

  /// As the last good step left it.
  virtual StepState state() const = 0;
  /// Goes on from the state of another motion of the same scene and level; `seen`: its ranges until then.
  virtual void restore(const StepState& state, const std::vector<SignalRange>& seen) = 0;
};

/// Elastic energy, kinetic energy, strain and stretch of a state into a row; x, v: [nodes * 3].
void measure(const scene::Mesh& mesh, const double* x, const double* v, StepRow& row);

} // namespace hopmesh::levels
