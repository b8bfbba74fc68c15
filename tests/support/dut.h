// A device under test: one array on a bus of its own, with peek, strict poke, and time in cycles.
#pragma once

#include "rtl_model/systemc/device.h"

#include <tlm_utils/simple_initiator_socket.h>

namespace hopmesh::tests {

/// Owns a device, its interrupt signal and an initiator. Several may live in one elaboration; make all of
/// them before the first transfer. Time moves only by run_cycles and run_until_done.
class Dut : public sc_core::sc_module {
 public:
  Dut(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology)
      : sc_module(name), device("device", array, topology), socket("socket"), irq("irq") {
    socket.bind(device.socket);
    device.irq.bind(irq);
  }

  systemc::Device device;
  tlm_utils::simple_initiator_socket<Dut> socket;
  sc_core::sc_signal<bool> irq;
  sc_core::sc_time last_delay; ///< of the last transfer

  /// A transfer of whole words; returns its response. Timing is only recorded.
  tlm::tlm_response_status transfer(tlm::tlm_command command, std::uint64_t address, void* data,
                                    unsigned bytes) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(static_cast<unsigned char*>(data));
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    return send(payload);
  }
  tlm::tlm_response_status send(tlm::tlm_generic_payload& payload) {
    elaborate();
    last_delay = sc_core::SC_ZERO_TIME;
    socket->b_transport(payload, last_delay);
    return payload.get_response_status();
  }
  std::uint32_t read(std::uint32_t address) {
    std::uint32_t word = 0;
    transfer(tlm::TLM_READ_COMMAND, address, &word, 4);
    return word;
  }
  tlm::tlm_response_status write(std::uint32_t address, std::uint32_t word) {
    return transfer(tlm::TLM_WRITE_COMMAND, address, &word, 4);
  }
  tlm::tlm_response_status write(std::uint32_t address, const std::vector<std::int32_t>& words) {
    return words.empty() ? tlm::TLM_OK_RESPONSE
                         : transfer(tlm::TLM_WRITE_COMMAND, address, const_cast<std::int32_t*>(words.data()),
                                    static_cast<unsigned>(4 * words.size()));
  }
  std::vector<std::int32_t> read(std::uint32_t address, std::size_t count) {
    std::vector<std::int32_t> words(count);
    if (count) transfer(tlm::TLM_READ_COMMAND, address, words.data(), static_cast<unsigned>(4 * count));
    return words;
  }

  /// Writes START; cycle 0 begins when that transfer ends.
  void start(std::uint32_t threshold_raw, std::uint32_t max_sweeps) {
    write(HM_REG_THRESHOLD, threshold_raw);
    write(HM_REG_MAX_SWEEPS, max_sweeps);
    write(HM_REG_CONTROL, HM_CONTROL_START);
    started_ = sc_core::sc_time_stamp() + last_delay;
  }
  /// Lets everything up to and including the edge that ends cycle n - 1 of the run happen: n cycles have
  /// passed.
  void run_to_cycle(std::uint64_t n) {
    const auto target = started_ + device.cells.period() * (static_cast<double>(n) + 0.25);
    sc_core::sc_start(target - sc_core::sc_time_stamp());
  }
  void run_until_done() {
    while (read(HM_REG_STATUS) & HM_STATUS_BUSY) sc_core::sc_start(device.cells.period() * 4096);
  }
  /// Ends elaboration; nothing after the first time. Time that passes without an event is what many tests
  /// want.
  static void elaborate() {
    if (sc_core::sc_get_status() >= sc_core::SC_START_OF_SIMULATION) return;
    sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  }

 private:
  sc_core::sc_time started_;
};

} // namespace hopmesh::tests
