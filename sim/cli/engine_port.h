// The level `engine`: the native array behind the firmware's bus.
#pragma once

#include "sim/engine/device.h"
#include "sim/study/array_port.h"

namespace hopmesh::cli {

class EnginePort : public study::ArrayPort {
 public:
  /// `stop` ends a relaxation between two sweeps.
  EnginePort(const spec::ArraySpec& array, const spec::Topology& topology, const engine::Options& options,
             const std::atomic<bool>& stop)
      : device_(array, topology, options, stop) {}

  const engine::Engine& engine() const { return device_.engine(); }

  const hm_bus& bus() override { return device_.bus(); }
  std::vector<study::SignalRange> inner_ranges() const override;

 private:
  engine::Device device_;
};

} // namespace hopmesh::cli
