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

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override;
  void begin_step(std::uint64_t step) override;
  void end_step(std::uint64_t step) override;
  void finish() override;
  std::vector<SignalRange> inner_ranges() const override;
  std::string trouble() const override { return wave_ ? wave_->trouble() : ""; }

 private:
  /// What the wave has to know once the device has answered; `was_running` before that.
  void show(bool was_running);

  engine::Device device_;
  const std::atomic<bool>& stop_;
  std::optional<EngineWave> wave_;
};

} // namespace hopmesh::levels
