// The firmware's bus on a device under test.
#pragma once

#include "firmware/host_bus.h"
#include "tests/support/dut.h"

namespace hopmesh::tests {

class DutBus : public HostBus {
 public:
  explicit DutBus(Dut& dut) : dut_(dut) {}

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_READ_COMMAND, address, words, count);
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_WRITE_COMMAND, address, const_cast<std::uint32_t*>(words), count);
  }
  int wait_for_irq() override {
    const sc_core::sc_time period = dut_.device.cells.period();
    sc_core::sc_start(dut_.last_delay + period); // what was written last must have arrived
    for (int patience = 0; patience < 1000000 && !dut_.irq.read(); ++patience) sc_core::sc_start(period * 64);
    return dut_.irq.read() ? HM_OK : HM_ERROR_STOPPED;
  }

 private:
  int transfer(tlm::tlm_command command, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
    return dut_.transfer(command, address, words, 4 * count) == tlm::TLM_OK_RESPONSE ? HM_OK : HM_ERROR_BUS;
  }

  Dut& dut_;
};

} // namespace hopmesh::tests
