// The level `rtl`: the Verilated RTL behind the firmware's bus, clock by clock.
#pragma once

#include "sim/levels/array_port.h"
#include "sim/levels/ports/rtl_model.h"
#include "sim/machine/rtl/rtl_parameters.h"

#include <atomic>

namespace hopmesh::levels {

/// Time passes while the bus is held and while the host waits. `library` must be a model of the array with
/// `room`, in which the network fits, and outlive the port.
class RtlPort : public ArrayPort {
 public:
  RtlPort(const RtlLibrary& library, const spec::ArraySpec& array, const spec::Topology& topology,
          const machine::RtlRoom& room, const std::atomic<bool>& stop);
  ~RtlPort() override;

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override;

 private:
  const RtlLibrary& library_;
  void* const model_;
  const std::atomic<bool>& stop_;
};

} // namespace hopmesh::levels
