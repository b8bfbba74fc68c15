// A motion that can be advanced step by step: the study's view of a level. Nobody above can tell which one it
// is.
#pragma once

#include "sim/levels/array_port.h"
#include "sim/levels/built_mesh.h"
#include "sim/levels/bus_error.h"
#include "sim/levels/step_row.h"
#include "sim/levels/step_state.h"

#include <stdexcept>

namespace hopmesh::levels {

/// A function of an emulated host's program. Library functions that it calls, those of soft floats among
/// them, are in `with_library`, too.
struct HostFunction {
  std::string name;
  std::uint64_t instructions = 0, with_library = 0;
};

/// What is known of the host of an array beside the instructions in its rows: of all steps of this process.
struct HostCounts {
  std::vector<HostFunction> functions; ///< the longest first; empty where nobody counts
  std::uint64_t memory_bytes = 0;      ///< program and stack included; 0 where nobody knows
};

/// The step had no finite answer; what() says in a sentence what was found.
class LostMotion : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Mover {
 public:
  virtual ~Mover() = default;
  /// Does the next step. Throws LostMotion or Stopped with the state of the last good step kept.
  virtual StepRow advance() = 0;
  virtual const std::vector<double>& positions() const = 0; ///< [nodes * 3]
  /// V at rest as raw codes, [nodes * components]; empty at levels without codes.
  virtual std::vector<std::int32_t> outputs_raw() const { return {}; }
  virtual std::vector<SignalRange> ranges() const { return {}; }
  /// Seconds of processor time that went into judging the steps, not into making them.
  virtual double judging_seconds() const { return 0; }
  virtual HostCounts host_counts() const { return {}; }

  /// As the last good step left it.
  virtual StepState state() const = 0;
  /// Goes on from the state of another motion of the same scene and level; `seen`: its ranges until then.
  virtual void restore(const StepState& state, const std::vector<SignalRange>& seen) = 0;
};

/// Elastic energy, kinetic energy, strain and stretch of a state into a row; x, v: [nodes * 3].
void measure(const scene::Mesh& mesh, const double* x, const double* v, StepRow& row);

} // namespace hopmesh::levels
