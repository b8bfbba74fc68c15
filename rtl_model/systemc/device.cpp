#include "rtl_model/systemc/device.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/signals.h"

#include <cstring>

namespace hopmesh::systemc {

Device::Device(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology)
    : sc_module(name), socket("socket"), irq(spec::irq_signal.name),
      array_(make_array(spec::cells_scope, array, topology)), cells(*array_) {
  socket.register_b_transport(this, &Device::b_transport);
  socket.register_transport_dbg(this, &Device::transport_dbg);
  SC_METHOD(on_run_done);
  sensitive << cells.sequencer.run_done();
  dont_initialize();
  SC_METHOD(on_reset_done);
  sensitive << reset_done_;
  dont_initialize();
  SC_METHOD(drive_irq);
  sensitive << irq_changed_;
  for (const auto& [offset, word] :
       spec::capability_words(cells.array(), cells.topology(), cells.phases().size()))
    registers_.set(offset, word);
  set_windows();
}

// ---- the bus
// ------------------------------------------------------------------------------------------------

void Device::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  Place place;
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge(payload, place));
  const bool good = payload.is_response_ok();
  const std::uint64_t held =
      good ? spec::bus_cycles(cells.array(), payload.get_data_length() / 4) : spec::error_cycles;
  bus_cycles_ += held;
  delay += cells.period() * static_cast<double>(held);
  if (good) transfer(payload, place, delay);
}

tlm::tlm_response_status Device::judge(const tlm::tlm_generic_payload& payload, Place& place) const {
  const std::uint64_t address = payload.get_address(), bytes = payload.get_data_length();
  if (payload.get_command() != tlm::TLM_READ_COMMAND && payload.get_command() != tlm::TLM_WRITE_COMMAND)
    return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (payload.get_byte_enable_ptr() != nullptr) return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  if (bytes == 0 || bytes % 4 != 0 || payload.get_streaming_width() < bytes ||
      payload.get_data_ptr() == nullptr)
    return tlm::TLM_BURST_ERROR_RESPONSE;
  if (address % 4 != 0 || !find(address, place)) return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (place.window == nullptr && bytes != 4) return tlm::TLM_BURST_ERROR_RESPONSE;
  if (place.window != nullptr && place.index + bytes / 4 > place.window->at.words())
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (place.window != nullptr && busy()) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  const bool allowed =
      payload.is_read() || (place.window ? place.window->put != nullptr
                                         : registers_.writable(static_cast<std::uint32_t>(address)));
  return allowed ? tlm::TLM_OK_RESPONSE : tlm::TLM_COMMAND_ERROR_RESPONSE;
}

bool Device::find(std::uint64_t address, Place& place) const {
  place = Place{};
  if (address < HM_REGISTER_BYTES) return registers_.has(static_cast<std::uint32_t>(address));
  for (const Window& window : windows_)
    if (window.at.holds(address)) {
      place = Place{&window, (address - window.at.offset) / 4};
      return true;
    }
  return false;
}

// Moves whole words between the payload and what `write` and the getters reach.
template <typename Write>
void Device::move_words(tlm::tlm_generic_payload& payload, const Place& place, std::uint64_t words,
                        Write write) {
  const auto offset = static_cast<std::uint32_t>(payload.get_address());
  unsigned char* at = payload.get_data_ptr();
  for (std::uint64_t k = 0; k < words; ++k, at += 4) {
    std::uint32_t word;
    if (payload.is_read()) {
      word = place.window ? get_word(*place.window, place.index + k) : read_register(offset);
      std::memcpy(at, &word, 4);
    } else {
      std::memcpy(&word, at, 4);
      write(offset, place.index + k, word);
    }
  }
}

void Device::transfer(tlm::tlm_generic_payload& payload, const Place& place, const sc_core::sc_time& delay) {
  if (payload.is_read() && !place.window) latch(static_cast<std::uint32_t>(payload.get_address()));
  move_words(payload, place, payload.get_data_length() / 4,
             [&](std::uint32_t offset, std::uint64_t index, std::uint32_t word) {
               if (place.window)
                 put_word(*place.window, index, word);
               else
                 write_register(offset, word, delay);
             });
}

unsigned Device::transport_dbg(tlm::tlm_generic_payload& payload) {
  Place place;
  const std::uint64_t address = payload.get_address();
  if (address % 4 != 0 || payload.get_data_ptr() == nullptr || !find(address, place)) return 0;
  if (!payload.is_read() && !payload.is_write()) return 0;
  const std::uint64_t room = place.window ? place.window->at.words() - place.index : 1;
  const std::uint64_t words = std::min<std::uint64_t>(payload.get_data_length() / 4, room);
  move_words(payload, place, words, [&](std::uint32_t offset, std::uint64_t index, std::uint32_t word) {
    if (place.window && place.window->put)
      put_word(*place.window, index, word);
    else if (!place.window && registers_.writable(offset))
      store(offset, word, sc_core::SC_ZERO_TIME);
  });
  return static_cast<unsigned>(4 * words);
}

// ---- registers
// ----------------------------------------------------------------------------------------------

std::uint32_t Device::read_register(std::uint32_t offset) const {
  if (offset == HM_REG_BUS_CYCLES_LO) return static_cast<std::uint32_t>(bus_cycles_);
  return registers_.read(offset);
}

// The high word that belongs to a low one stays until the next low one is read.
void Device::latch(std::uint32_t offset) {
  if (offset == HM_REG_CYCLES_LO)
    registers_.set(HM_REG_CYCLES_HI, static_cast<std::uint32_t>(run_cycles_ >> 32));
  if (offset == HM_REG_LARGEST_SUM_LO)
    registers_.set(HM_REG_LARGEST_SUM_HI, static_cast<std::uint32_t>(largest_sum_ >> 32));
  if (offset == HM_REG_BUS_CYCLES_LO)
    registers_.set(HM_REG_BUS_CYCLES_HI, static_cast<std::uint32_t>(bus_cycles_ >> 32));
}

void Device::write_register(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay) {
  if (offset == HM_REG_CONTROL) return control(word, delay);
  store(offset, word, delay);
}

void Device::store(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay) {
  if (offset == HM_REG_IRQ_TEST) return raise(word & registers_.fields(offset), delay);
  registers_.write(offset, word);
  if (offset == HM_REG_IRQ_ENABLE || offset == HM_REG_IRQ_STATUS) irq_changed_.notify(delay);
}

void Device::raise(std::uint32_t causes, const sc_core::sc_time& delay) {
  registers_.set(HM_REG_IRQ_STATUS, registers_.read(HM_REG_IRQ_STATUS) | causes);
  irq_changed_.notify(delay);
}

// An ABORT is for what is at work before this word; a run that the word itself begins goes on.
void Device::control(std::uint32_t word, const sc_core::sc_time& delay) {
  const bool begins = (word & (HM_CONTROL_START | HM_CONTROL_RESET)) != 0, was_busy = busy();
  const bool aborts = (word & HM_CONTROL_ABORT) != 0 && was_busy;
  if (aborts && !resetting_) cells.sequencer.abort();
  if (was_busy && (begins || (aborts && resetting_))) raise(HM_IRQ_REFUSED, delay);
  if (was_busy || !begins) return;
  const sc_core::sc_time from = word & HM_CONTROL_RESET ? reset_array(delay) : delay;
  if (word & HM_CONTROL_START) start_run(from);
}

// STATUS decides, not the sequencer: that one is idle a delta cycle before STATUS and the counters say so,
// and a START in between would be reported as done.
bool Device::busy() const {
  return (registers_.read(HM_REG_STATUS) & HM_STATUS_BUSY) != 0;
}

void Device::start_run(const sc_core::sc_time& delay) {
  registers_.set(HM_REG_STATUS, HM_STATUS_BUSY);
  const std::uint32_t stop = registers_.read(HM_REG_STOP);
  const std::uint64_t high = registers_.read(HM_REG_SUM_THRESHOLD_HI);
  const spec::StopRule rule{HM_FIELD(stop, STOP_BY_SUM) != 0, static_cast<int>(HM_FIELD(stop, STOP_SHARE)),
                            high << 32 | registers_.read(HM_REG_SUM_THRESHOLD_LO)};
  cells.sequencer.begin_run(registers_.read(HM_REG_THRESHOLD), registers_.read(HM_REG_MAX_SWEEPS), rule,
                            delay);
}

// Returns how long from now on it is at work.
sc_core::sc_time Device::reset_array(const sc_core::sc_time& delay) {
  registers_.reset();
  bus_cycles_ = run_cycles_ = largest_sum_ = 0;
  for (const Window& window : windows_)
    for (std::uint64_t k = 0; window.put && k < window.at.codes; ++k) (this->*window.put)(k, 0);
  irq_changed_.notify(sc_core::SC_ZERO_TIME);
  const auto cycles = static_cast<double>(spec::reset_cycles(cells.array(), cells.topology()));
  const sc_core::sc_time end = cells.sequencer.until_edge(delay) + cells.period() * cycles;
  registers_.set(HM_REG_STATUS, HM_STATUS_BUSY);
  resetting_ = true;
  reset_done_.notify(end);
  return end;
}

// Where a START came with it, the run begins in this instant.
void Device::on_reset_done() {
  resetting_ = false;
  if (!cells.sequencer.busy()) registers_.set(HM_REG_STATUS, 0);
}

void Device::on_run_done() {
  const Sequencer& s = cells.sequencer;
  registers_.set(HM_REG_STATUS, HM_STATUS_DONE | (s.converged() ? HM_STATUS_CONVERGED : 0) |
                                    (s.aborted() ? HM_STATUS_ABORTED : 0));
  registers_.set(HM_REG_SWEEPS, static_cast<std::uint32_t>(s.sweeps()));
  registers_.set(HM_REG_LARGEST_CHANGE, static_cast<std::uint32_t>(cells.detector.largest_change()));
  largest_sum_ = static_cast<std::uint64_t>(cells.detector.largest_sum());
  registers_.set(HM_REG_LARGEST_SUM_LO, static_cast<std::uint32_t>(largest_sum_));
  run_cycles_ = s.run_cycles();
  registers_.set(HM_REG_CYCLES_LO, static_cast<std::uint32_t>(run_cycles_));
  raise(HM_IRQ_DONE, sc_core::SC_ZERO_TIME);
}

void Device::drive_irq() {
  irq.write((registers_.read(HM_REG_IRQ_STATUS) & registers_.read(HM_REG_IRQ_ENABLE)) != 0);
}

} // namespace hopmesh::systemc
