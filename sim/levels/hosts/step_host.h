// Who runs the firmware's steps beside an array: this very processor, or one that is emulated.
#pragma once

#include "firmware/driver.h"
#include "firmware/integrator.h"
#include "sim/levels/mover.h"
#include "sim/levels/step_memory.h"
#include "sim/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace hopmesh::levels {

/// What a host stands on; all of it outlives the host. `memory` is where a step begins and ends, whoever runs
/// it.
struct HostPlace {
  HostBus& bus;
  const hm_mesh& mesh;
  const hm_step_parameters& motion; ///< node_force may change between steps
  const scene::RelaxSpec& relax;
  StepMemory& memory;
};

/// What a step came to.
struct HostStep {
  hm_step_result result{};
  hm_relaxation last{};              ///< the last expansion's, corrections added
  std::vector<std::uint32_t> sweeps; ///< of each relaxation
  std::uint64_t instructions = 0;    ///< 0 where nobody counts them
};

class StepHost {
 public:
  virtual ~StepHost() = default;

  /// Looks at the array and writes what it needs once. As hm_driver_open and hm_driver_put_momentum answer.
  virtual int open() = 0;
  /// As hm_step answers; driver().clipped and .vanished are the step's.
  virtual int step(HostStep& step) = 0;
  /// What open() found, and the last load. Of an emulated host without its bus.
  virtual const hm_driver& driver() const = 0;

  /// Weights that the array has, where a later step may go on with them; empty: none.
  virtual std::vector<double> loaded_weights() const { return {}; }
  /// Puts them back into an array that was made anew. As hm_driver_restore answers.
  virtual int restore(const std::vector<double>& weights, int shift) = 0;

  /// Of all steps until now, the longest first; empty where nobody counts.
  virtual std::vector<HostFunction> functions() const { return {}; }
  /// Bytes of memory, stack and program included; 0 where nobody knows.
  virtual std::uint64_t memory_bytes() const { return 0; }
};

/// The host that scene.host describes. Throws input::InputError where this build has no such host, or where
/// that host does not take such a motion.
std::unique_ptr<StepHost> make_host(const scene::Scene& scene, const spec::ArraySpec& array,
                                    const HostPlace& place);

} // namespace hopmesh::levels
