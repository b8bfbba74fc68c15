// The level `systemc`: the cycle-level array behind the firmware's bus. Only here does the program meet
// SystemC.
#pragma once

#include "sim/levels/array_port.h"
#include "sim/levels/waves/wave.h"

#include <atomic>
#include <tlm_utils/simple_initiator_socket.h>

namespace hopmesh::levels {

/// Owns a device and the host's side of its bus. Time passes while the firmware waits; transfers before that
/// add up in a local delay (loosely timed), so START takes effect when the bus would have delivered it. While
/// the device is at work each transfer waits out those before it, and sees the cycle in which it begins.
class SystemcPort : public sc_core::sc_module, public ArrayPort {
 public:
  SC_HAS_PROCESS(SystemcPort);
  SystemcPort(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology,
              systemc::Waking waking, const WaveRequest& wave, const std::atomic<bool>& stop);

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_READ_COMMAND, address, words, count);
  }
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override {
    return transfer(tlm::TLM_WRITE_COMMAND, address, const_cast<std::uint32_t*>(words), count);
  }
  int wait_for_irq() override;
  void begin_step(std::uint64_t step) override;
  void end_step(std::uint64_t step) override;
  std::vector<SignalRange> inner_ranges() const override;
  std::string trouble() const override { return wave_ ? wave_->trouble() : ""; }

 private:
  int transfer(tlm::tlm_command command, std::uint32_t address, std::uint32_t* words, std::uint32_t count);
  void pass_delay();
  sc_core::sc_time next_slice(sc_core::sc_time began, std::uint64_t cycles_before, bool& wave_changes) const;
  void on_irq();

  systemc::Device device_;
  tlm_utils::simple_initiator_socket<SystemcPort> socket_;
  sc_core::sc_signal<bool> irq_;
  sc_core::sc_time delay_;
  std::optional<Wave> wave_;
  const std::atomic<bool>& stop_;
};

} // namespace hopmesh::levels
