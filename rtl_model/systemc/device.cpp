#include "rtl_model/systemc/device.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/signals.h"

#include <cstring>

namespace hopmesh::systemc {

namespace {

/// The low bits that a memory of this format keeps, sign extended.
std::int32_t cut(std::uint32_t word, const spec::NumberFormat& f) {
  const int unused = 32 - f.width;
  return static_cast<std::int32_t>(word << unused) >> unused;
}

} // namespace

Device::Device(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology)
    : sc_module(name), socket("socket"), irq(spec::irq_signal.name),
      array_(make_array(spec::cells_scope, array, topology)), cells(*array_) {
  socket.register_b_transport(this, &Device::b_transport);
  socket.register_transport_dbg(this, &Device::transport_dbg);
  SC_METHOD(on_run_done);
  sensitive << cells.sequencer.run_done();
  dont_initialize();
  SC_METHOD(drive_irq);
  sensitive << irq_changed_;
  for (const auto& [offset, word] :
       spec::capability_words(cells.array(), cells.topology(), cells.phases().size()))
    registers_.set(offset, word);
  set_windows();
}

void Device::set_windows() {
  const spec::Topology& t = cells.topology();
  windows_[HM_WINDOW_FIRST_LINK] = {t.first_link.size(), false, &Device::get_first_link, nullptr};
  windows_[HM_WINDOW_LINK] = {t.link_to.size(), false, &Device::get_link, nullptr};
  windows_[HM_WINDOW_BIAS] = {t.neurons(), true, &Device::get_bias, &Device::put_bias};
  windows_[HM_WINDOW_OUTPUT] = {t.neurons(), true, &Device::get_output, &Device::put_output};
  windows_[HM_WINDOW_WEIGHT] = {t.weight_words(), true, &Device::get_weight, &Device::put_weight};
}

// ---- the bus
// ------------------------------------------------------------------------------------------------

void Device::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  Place place;
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge(payload, place));
  if (payload.is_response_error()) return;
  const std::uint64_t held = spec::bus_cycles(cells.array(), payload.get_data_length() / 4);
  bus_cycles_ += held;
  delay += cells.period() * static_cast<double>(held);
  transfer(payload, place, delay);
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
  if (place.window != nullptr && place.index + bytes / 4 > place.window->words)
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (payload.is_read()) return tlm::TLM_OK_RESPONSE;
  const bool allowed = place.window == nullptr ? registers_.writable(static_cast<std::uint32_t>(address))
                                               : place.window->writable && !busy();
  return allowed ? tlm::TLM_OK_RESPONSE : tlm::TLM_COMMAND_ERROR_RESPONSE;
}

bool Device::find(std::uint64_t address, Place& place) const {
  place = Place{};
  if (address < HM_WINDOW_FIRST_LINK) return registers_.has(static_cast<std::uint32_t>(address));
  if (address > UINT32_MAX) return false;
  const auto above = windows_.upper_bound(static_cast<std::uint32_t>(address));
  const auto& [base, window] = *std::prev(above);
  place = Place{&window, (address - base) / 4};
  return place.index < window.words;
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
      word = place.window ? (this->*place.window->get)(place.index + k) : read_register(offset);
      std::memcpy(at, &word, 4);
    } else {
      std::memcpy(&word, at, 4);
      write(offset, place.index + k, word);
    }
  }
}

void Device::transfer(tlm::tlm_generic_payload& payload, const Place& place, const sc_core::sc_time& delay) {
  move_words(payload, place, payload.get_data_length() / 4,
             [&](std::uint32_t offset, std::uint64_t index, std::uint32_t word) {
               if (place.window)
                 (this->*place.window->put)(index, word);
               else
                 write_register(offset, word, delay);
             });
}

unsigned Device::transport_dbg(tlm::tlm_generic_payload& payload) {
  Place place;
  const std::uint64_t address = payload.get_address();
  if (address % 4 != 0 || payload.get_data_ptr() == nullptr || !find(address, place)) return 0;
  if (!payload.is_read() && !payload.is_write()) return 0;
  const std::uint64_t room = place.window ? place.window->words - place.index : 1;
  const std::uint64_t words = std::min<std::uint64_t>(payload.get_data_length() / 4, room);
  move_words(payload, place, words, [&](std::uint32_t offset, std::uint64_t index, std::uint32_t word) {
    if (place.window && place.window->writable)
      (this->*place.window->put)(index, word);
    else if (!place.window && registers_.writable(offset))
      store(offset, word, sc_core::SC_ZERO_TIME);
  });
  return static_cast<unsigned>(4 * words);
}

// ---- registers
// ----------------------------------------------------------------------------------------------

std::uint32_t Device::read_register(std::uint32_t offset) const {
  if (offset == HM_REG_BUS_CYCLES_LO) return static_cast<std::uint32_t>(bus_cycles_);
  if (offset == HM_REG_BUS_CYCLES_HI) return static_cast<std::uint32_t>(bus_cycles_ >> 32);
  return registers_.read(offset);
}

void Device::write_register(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay) {
  if (offset == HM_REG_CONTROL) return control(word, delay);
  store(offset, word, delay);
}

void Device::store(std::uint32_t offset, std::uint32_t word, const sc_core::sc_time& delay) {
  registers_.write(offset, word);
  if (offset == HM_REG_IRQ_ENABLE || offset == HM_REG_IRQ_STATUS) irq_changed_.notify(delay);
}

void Device::control(std::uint32_t word, const sc_core::sc_time& delay) {
  if ((word & (HM_CONTROL_START | HM_CONTROL_RESET)) == 0) return;
  if (busy()) {
    registers_.set(HM_REG_IRQ_STATUS, registers_.read(HM_REG_IRQ_STATUS) | HM_IRQ_REFUSED);
    irq_changed_.notify(delay);
    return;
  }
  if (word & HM_CONTROL_RESET) reset_array();
  if (word & HM_CONTROL_START) start_run(delay);
}

// STATUS decides, not the sequencer: that one is idle a delta cycle before STATUS and the counters say so,
// and a START in between would be reported as done.
bool Device::busy() const {
  return (registers_.read(HM_REG_STATUS) & HM_STATUS_BUSY) != 0;
}

void Device::start_run(const sc_core::sc_time& delay) {
  registers_.set(HM_REG_STATUS, HM_STATUS_BUSY);
  cells.sequencer.begin_run(registers_.read(HM_REG_THRESHOLD), registers_.read(HM_REG_MAX_SWEEPS), delay);
}

void Device::reset_array() {
  registers_.reset();
  bus_cycles_ = 0;
  for (auto& [base, window] : windows_)
    for (std::uint64_t k = 0; window.writable && k < window.words; ++k) (this->*window.put)(k, 0);
  irq_changed_.notify(sc_core::SC_ZERO_TIME);
}

void Device::on_run_done() {
  const Sequencer& s = cells.sequencer;
  registers_.set(HM_REG_STATUS, HM_STATUS_DONE | (s.converged() ? HM_STATUS_CONVERGED : 0));
  registers_.set(HM_REG_SWEEPS, static_cast<std::uint32_t>(s.sweeps()));
  registers_.set(HM_REG_LARGEST_CHANGE, static_cast<std::uint32_t>(cells.detector.largest_change()));
  registers_.set(HM_REG_CYCLES_LO, static_cast<std::uint32_t>(s.run_cycles()));
  registers_.set(HM_REG_CYCLES_HI, static_cast<std::uint32_t>(s.run_cycles() >> 32));
  registers_.set(HM_REG_IRQ_STATUS, registers_.read(HM_REG_IRQ_STATUS) | HM_IRQ_DONE);
  irq_changed_.notify(sc_core::SC_ZERO_TIME);
}

void Device::drive_irq() {
  irq.write((registers_.read(HM_REG_IRQ_STATUS) & registers_.read(HM_REG_IRQ_ENABLE)) != 0);
}

// ---- windows
// ------------------------------------------------------------------------------------------------

std::uint32_t Device::get_first_link(std::uint64_t k) const {
  return cells.topology().first_link[k];
}
std::uint32_t Device::get_link(std::uint64_t k) const {
  return cells.topology().link_to[k];
}

std::uint32_t Device::get_bias(std::uint64_t k) const {
  return static_cast<std::uint32_t>(cells.bias(k));
}

std::uint32_t Device::get_output(std::uint64_t k) const {
  return static_cast<std::uint32_t>(cells.state_raw(k));
}

std::uint32_t Device::get_weight(std::uint64_t k) const {
  const auto [neuron, tap] = weight_place(k);
  return static_cast<std::uint32_t>(cells.weight(neuron, tap));
}

void Device::put_bias(std::uint64_t k, std::uint32_t word) {
  cells.set_bias(k, cut(word, cells.array().formats.bias));
}

void Device::put_output(std::uint64_t k, std::uint32_t word) {
  cells.load(k, static_cast<std::int32_t>(word));
}

void Device::put_weight(std::uint64_t k, std::uint32_t word) {
  const auto [neuron, tap] = weight_place(k);
  cells.set_weight(neuron, tap, cut(word, cells.array().formats.weight));
}

std::pair<std::size_t, std::size_t> Device::weight_place(std::uint64_t k) const {
  const spec::Topology& t = cells.topology();
  const std::size_t per_cell = t.neurons_per_cell;
  std::size_t low = 0, high = t.cells(); // the last cell whose rows begin at or before k
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (t.row_offset(middle, 0) <= k ? low : high) = middle;
  }
  const std::size_t within = k - t.row_offset(low, 0);
  return {low * per_cell + within / t.taps(low), within % t.taps(low)};
}

} // namespace hopmesh::systemc
