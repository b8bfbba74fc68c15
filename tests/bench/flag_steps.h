// The scene that benchmarks run, stepped by the firmware on a device, with the time of every part of the way
// taken.
#pragma once

#include "firmware/driver.h"
#include "firmware/host_bus.h"
#include "sim/levels/step_memory.h"
#include "sim/scene/scene_file.h"
#include "tests/support/dut.h"

#include <optional>

namespace hopmesh::bench {

/// Seconds of processor time since the process began: a busy neighbour disturbs it less than the wall clock.
double processor_seconds();

/// Processor seconds by part. The driver's is what hm_driver_relax takes beside bus and array.
struct PartSeconds {
  double array = 0, bus = 0, driver = 0, network_and_motion = 0;
};

/// The way of the data without study and record: integrator, driver, bus, device.
class FlagSteps : private HostBus {
 public:
  FlagSteps(const scene::Scene& scene, const levels::BuiltMesh& mesh, tests::Dut& dut);

  /// Steps from rest, from the scene's start on.
  void begin();
  void advance();

  std::vector<std::int32_t> start_raw() const; ///< V before the last step's relaxation, as raw codes
  const PartSeconds& seconds() const { return seconds_; }
  std::uint64_t sweeps() const { return sweeps_; }
  std::uint64_t cycles() const { return cycles_; }

 private:
  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_READ_COMMAND, address, words, count);
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_WRITE_COMMAND, address, const_cast<std::uint32_t*>(words), count);
  }
  int wait_for_irq() override;
  int transfer(tlm::tlm_command command, std::uint32_t address, std::uint32_t* words, std::uint32_t count);
  static int relax(void* self, const hm_mesh* mesh, hm_network* network, double threshold,
                   std::uint32_t max_sweeps, hm_relaxation* result);

  const levels::BuiltMesh& mesh_;
  tests::Dut& dut_;
  const hm_step_parameters parameters_;
  hm_driver driver_{};
  std::optional<levels::StepMemory> memory_; ///< anew at every begin()
  std::vector<std::uint32_t> buffer_;
  PartSeconds seconds_;
  std::uint64_t sweeps_ = 0, cycles_ = 0;
};

} // namespace hopmesh::bench
