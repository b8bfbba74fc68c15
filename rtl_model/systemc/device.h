// The array as others see it: a TLM-2.0 target socket, a register file, windows onto weights, biases and
// outputs, and an interrupt line. This is the module to put into somebody else's sc_main
// (docs/hardware/registers.md, tests/example/).
#pragma once

#include "rtl_model/spec/memory_map.h"
#include "rtl_model/systemc/neuron_array.h"
#include "rtl_model/systemc/register_file.h"

#include <tlm>
#include <tlm_utils/simple_target_socket.h>

namespace hopmesh::systemc {

/// Loosely timed: b_transport acts at once, adds the transfer's cycles to the delay and never waits. So
/// registers show the instant of the call: a host that wants them to the cycle has waited its delays out.
/// A bad transfer is answered by a TLM response, holds the bus for two cycles and changes nothing else:
///   address outside every register and window, or not a multiple of 4    TLM_ADDRESS_ERROR_RESPONSE
///   length not a multiple of 4, or over one register, or streaming       TLM_BURST_ERROR_RESPONSE
///   byte enables                                                         TLM_BYTE_ENABLE_ERROR_RESPONSE
///   a write to what is read only; a window while busy; other commands    TLM_COMMAND_ERROR_RESPONSE
/// transport_dbg moves the same words in no time, busy or not, starts and latches nothing; what is read only
/// stays. A RESET empties the memories at once for it, and is busy as long as hardware would be.
class Device : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Device);
  /// The array must have passed spec::validate for the topology's most_taps().
  Device(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);

  tlm_utils::simple_target_socket<Device> socket;
  sc_core::sc_out<bool> irq;

 private:
  const std::unique_ptr<NeuronArray> array_;

 public:
  NeuronArray& cells;

  /// Walks these cycles (counted over all runs) clock by clock instead of phase by phase.
  void walk(CycleWindow window) { cells.sequencer.walk(window); }
  /// A run or a RESET is at work, as STATUS tells.
  bool busy() const;
  void wake(Waking waking) { walk(CycleWindow{0, waking == Waking::by_clock ? UINT64_MAX : 0}); }

 private:
  struct Window {
    spec::MemoryWindow at;
    std::uint32_t (Device::*get)(std::uint64_t code) const = nullptr;
    void (Device::*put)(std::uint64_t code, std::uint32_t word) = nullptr; ///< none: read only
  };
  /// Where an address leads: a register, or a place in a window.
  struct Place {
    const Window* window = nullptr;
    std::uint64_t index = 0;
  };

  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  tlm::tlm_response_status judge(const tlm::tlm_generic_payload& payload, Place& place) const;
  bool find(std::uint64_t address, Place& place) const;
  template <typename Write>
  void move_words(tlm::tlm_generic_payload& payload, const Place& place, std::uint64_t words, Write write);
  void transfer(tlm::tlm_generic_payload& payload, const Place& place, const sc_core::sc_time& delay);
  std::uint32_t read_register(std::uint32_t offset) const;
  void write_register(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay);
  void store(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay);
  void latch(std::uint32_t offset);
  void control(std::uint32_t word, const sc_core::sc_time& delay);
  void raise(std::uint32_t causes, const sc_core::sc_time& delay);
  void start_run(const sc_core::sc_time& delay);
  sc_core::sc_time reset_array(const sc_core::sc_time& delay);
  void set_windows();
  void on_run_done();
  void on_reset_done();
  void drive_irq();

  std::uint32_t get_word(const Window& window, std::uint64_t index) const;
  void put_word(const Window& window, std::uint64_t index, std::uint32_t word);

  std::uint32_t get_first_link(std::uint64_t k) const;
  std::uint32_t get_link(std::uint64_t k) const;
  std::uint32_t get_bias(std::uint64_t k) const;
  std::uint32_t get_output(std::uint64_t k) const;
  std::uint32_t get_weight(std::uint64_t k) const;
  std::uint32_t get_momentum(std::uint64_t k) const;
  void put_bias(std::uint64_t k, std::uint32_t word);
  void put_output(std::uint64_t k, std::uint32_t word);
  void put_weight(std::uint64_t k, std::uint32_t word);
  void put_momentum(std::uint64_t k, std::uint32_t word);
  /// Neuron and tap of a word of the weight window.
  std::pair<std::size_t, std::size_t> weight_place(std::uint64_t k) const;

  RegisterFile registers_;
  std::array<Window, spec::window_count> windows_; ///< by spec::Window
  std::uint64_t bus_cycles_ = 0;
  std::uint64_t run_cycles_ = 0, largest_sum_ = 0; ///< of the last run
  bool resetting_ = false;
  sc_core::sc_event irq_changed_, reset_done_;
};

} // namespace hopmesh::systemc
