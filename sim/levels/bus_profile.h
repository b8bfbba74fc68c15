// Listens on a bus: the range of codes that pass through each window.
#pragma once

#include "rtl_model/spec/memory_map.h"
#include "sim/levels/array_port.h"

#include <array>

namespace hopmesh::levels {

/// Stands between firmware and array, and passes everything on unchanged.
class BusProfile : public HostBus {
 public:
  BusProfile(HostBus& inner, const spec::ArraySpec& array, const spec::Topology& topology);

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override { return inner_.wait_for_irq(); }

  std::vector<SignalRange> ranges() const { return {ranges_.begin(), ranges_.end()}; }

 private:
  void note(std::uint32_t address, const std::uint32_t* words, std::uint32_t count);

  HostBus& inner_;
  const spec::MemoryMap map_;
  std::array<SignalRange, 3> ranges_; ///< weight, bias, state
};

} // namespace hopmesh::levels
