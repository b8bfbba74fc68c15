// A device under test: one array on a bus of its own, with peek, strict poke, and time in cycles.
#pragma once

#include "rtl_model/systemc/device.h"

#include <tlm_utils/simple_initiator_socket.h>

namespace hopmesh::tests {

using spec::Window;

/// Owns a device, its interrupt signal and an initiator. Several may live in one elaboration; make all of
/// them before the first transfer. Time moves only by run_cycles and run_until_done.
class Dut : public sc_core::sc_module {
 public:
  Dut(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology)
      : sc_module(name), device("device", array, topology), socket("socket"), irq("irq"),
        map(spec::memory_map(array, topology)) {
    socket.bind(device.socket);
    device.irq.bind(irq);
  }

  systemc::Device device;
  tlm_utils::simple_initiator_socket<Dut> socket;
  sc_core::sc_signal<bool> irq;
  const spec::MemoryMap map;
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

  /// Where a window begins.
  std::uint32_t at(Window w) const { return static_cast<std::uint32_t>(map[w].offset); }
  /// The first codes of a window, taken out of their words.
  std::vector<std::int32_t> codes(Window w, std::size_t count) {
    const int n = map[w].codes_a_word, bits = 32 / n;
    const auto words = read(at(w), (count + n - 1) / n);
    std::vector<std::int32_t> codes;
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t turn = std::int64_t{1} << bits;
      const std::int64_t low =
          static_cast<std::uint32_t>(words[k / n]) / (std::int64_t{1} << bits * (k % n)) % turn;
      codes.push_back(static_cast<std::int32_t>(low >= turn / 2 ? low - turn : low));
    }
    return codes;
  }
  tlm::tlm_response_status put_codes(Window w, const std::vector<std::int32_t>& codes) {
    const int n = map[w].codes_a_word, bits = 32 / n;
    std::vector<std::int32_t> words((codes.size() + n - 1) / n);
    for (std::size_t k = 0; k < codes.size(); ++k) {
      const std::uint64_t low = static_cast<std::uint32_t>(codes[k]) % (std::uint64_t{1} << bits);
      words[k / n] =
          static_cast<std::int32_t>(static_cast<std::uint32_t>(words[k / n]) + (low << bits * (k % n)));
    }
    return write(at(w), words);
  }

  /// Begins a run.
  void start(std::uint32_t threshold_raw, std::uint32_t max_sweeps) {
    write(HM_REG_THRESHOLD, threshold_raw);
    write(HM_REG_MAX_SWEEPS, max_sweeps);
    command(HM_CONTROL_START);
  }
  /// Writes CONTROL; cycle 0 of what that begins is the first one behind the transfer.
  void command(std::uint32_t word) {
    write(HM_REG_CONTROL, word);
    const auto ends = sc_core::sc_time_stamp() + last_delay, late = ends % device.cells.period();
    started_ = late == sc_core::SC_ZERO_TIME ? ends : ends + device.cells.period() - late;
  }
  /// Lets everything up to and including the edge that ends cycle n - 1 of the run happen: n cycles have
  /// passed.
  void run_to_cycle(std::uint64_t n) {
    const auto target = started_ + device.cells.period() * (static_cast<double>(n) + 0.25);
    sc_core::sc_start(target - sc_core::sc_time_stamp());
  }
  /// Lets the last transfer end, and all that happens in that instant happen.
  void pass_delay() {
    if (last_delay != sc_core::SC_ZERO_TIME) sc_core::sc_start(last_delay);
    last_delay = sc_core::SC_ZERO_TIME;
    while (sc_core::sc_pending_activity_at_current_time()) sc_core::sc_start(sc_core::SC_ZERO_TIME);
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
