// The level `engine`: the native array behind the firmware's bus.
#pragma once

#include "sim/engine/device.h"
#include "sim/levels/array_port.h"
#include "sim/levels/waves/engine_wave.h"

namespace hopmesh::levels {

class EnginePort : public ArrayPort {
 public:
  /// `stop` ends a relaxation between two sweeps.
  EnginePort(const spec::ArraySpec& array, const spec::Topology& topology, const engine::Options& options,
             const WaveRequest& wave, const std::atomic<bool>& stop);

  const engine::Engine& engine() const { return device_.engine(); }

  const hm_bus& bus() override { return wave_ ? bus_ : device_.bus(); }
  void begin_step(std::uint64_t step) override;
  void end_step(std::uint64_t step) override;
  void finish() override;
  std::vector<SignalRange> inner_ranges() const override;
  std::string trouble() const override { return wave_ ? wave_->trouble() : ""; }

 private:
  int wait();
  int write(std::uint32_t address, std::uint32_t word);
  std::uint64_t bus_cycles() const;

  engine::Device device_;
  const std::atomic<bool>& stop_;
  std::optional<EngineWave> wave_;
  hm_bus bus_{}; ///< the device's, with an eye on runs and on the interrupt line
};

} // namespace hopmesh::levels
