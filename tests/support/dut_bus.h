// The firmware's five calls on a device under test.
#pragma once

#include "firmware/bus.h"
#include "tests/support/dut.h"

namespace hopmesh::tests {

class DutBus {
 public:
  explicit DutBus(Dut& dut) : dut_(dut), bus_{this, &read, &write, &read_burst, &write_burst, &wait} {}
  DutBus(const DutBus&) = delete;
  DutBus& operator=(const DutBus&) = delete;
  const hm_bus* bus() const { return &bus_; }

 private:
  static Dut& dut(void* self) { return static_cast<DutBus*>(self)->dut_; }
  static int transfer(void* self, tlm::tlm_command command, std::uint32_t address, const void* data,
                      std::uint32_t words) {
    return dut(self).transfer(command, address, const_cast<void*>(data), 4 * words) == tlm::TLM_OK_RESPONSE
               ? HM_OK
               : HM_ERROR_BUS;
  }
  static int read(void* self, std::uint32_t address, std::uint32_t* word) {
    return transfer(self, tlm::TLM_READ_COMMAND, address, word, 1);
  }
  static int write(void* self, std::uint32_t address, std::uint32_t word) {
    return transfer(self, tlm::TLM_WRITE_COMMAND, address, &word, 1);
  }
  static int read_burst(void* self, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
    return transfer(self, tlm::TLM_READ_COMMAND, address, words, count);
  }
  static int write_burst(void* self, std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
    return transfer(self, tlm::TLM_WRITE_COMMAND, address, words, count);
  }
  static int wait(void* self) {
    Dut& d = dut(self);
    const sc_core::sc_time period = d.device.cells.period();
    sc_core::sc_start(d.last_delay + period); // what was written last must have arrived
    for (int patience = 0; patience < 1000000 && !d.irq.read(); ++patience) sc_core::sc_start(period * 64);
    return d.irq.read() ? HM_OK : HM_ERROR_STOPPED;
  }

  Dut& dut_;
  hm_bus bus_;
};

} // namespace hopmesh::tests
