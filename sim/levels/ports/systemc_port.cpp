#include "sim/levels/ports/systemc_port.h"

// SystemC's library wants an sc_main. Programs that only use the levels have none of their own.
__attribute__((weak)) int sc_main(int, char**) {
  return 0;
}

namespace hopmesh::levels {

using sc_core::sc_time;

SystemcPort::SystemcPort(sc_core::sc_module_name name, const spec::ArraySpec& array,
                         const spec::Topology& topology, systemc::Waking waking, const WaveRequest& wave,
                         const std::atomic<bool>& stop)
    : sc_module(name), device_("device", array, topology), socket_("socket"), irq_("irq"), stop_(stop) {
  socket_.bind(device_.socket);
  device_.irq.bind(irq_);
  SC_METHOD(on_irq);
  sensitive << irq_.posedge_event();
  dont_initialize();
  device_.wake(waking);
  if (!wave.file.empty()) wave_.emplace(wave, device_, irq_, waking);
  // A wait may be cut into slices in which nothing happens; that is no news.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
}

int SystemcPort::transfer(tlm::tlm_command command, std::uint32_t address, std::uint32_t* words,
                          std::uint32_t count) {
  if (sc_core::sc_get_status() < sc_core::SC_START_OF_SIMULATION) sc_core::sc_start(sc_core::SC_ZERO_TIME);
  if (device_.busy()) pass_delay();
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(reinterpret_cast<unsigned char*>(words));
  payload.set_data_length(4 * count);
  payload.set_streaming_width(4 * count);
  socket_->b_transport(payload, delay_);
  return payload.is_response_ok() ? HM_OK : HM_ERROR_BUS;
}

// Until the last transfer is over, and all that happens in that instant is done: a step to an instant alone
// leaves its processes for the next one.
void SystemcPort::pass_delay() {
  if (delay_ != sc_core::SC_ZERO_TIME) sc_core::sc_start(delay_);
  delay_ = sc_core::SC_ZERO_TIME;
  while (sc_core::sc_pending_activity_at_current_time()) sc_core::sc_start(sc_core::SC_ZERO_TIME);
}

// In slices, so that a long relaxation can be stopped and a wave be opened in the middle of it.
int SystemcPort::wait_for_irq() {
  const sc_time period = device_.cells.period(), late = (sc_core::sc_time_stamp() + delay_) % period;
  const sc_time began =
      sc_core::sc_time_stamp() + delay_ + (late == sc_core::SC_ZERO_TIME ? late : period - late);
  const std::uint64_t cycles_before = device_.cells.sequencer.total_cycles();
  pass_delay(); // the line shows what the last transfer did
  while (!irq_.read()) {
    if (stop_ || !device_.busy()) return HM_ERROR_STOPPED; // nothing will raise the line
    if (wave_) wave_->close_when_disk_full();
    bool wave_changes = false;
    sc_core::sc_start(next_slice(began, cycles_before, wave_changes));
    if (wave_changes && !irq_.read()) wave_->change();
  }
  return HM_OK;
}

sc_time SystemcPort::next_slice(sc_time began, std::uint64_t cycles_before, bool& wave_changes) const {
  const sc_time slice = device_.cells.period() * (wave_ && wave_->open_now() ? 1e3 : 1e6);
  const auto change = wave_ ? wave_->next_change(began, cycles_before) : std::nullopt;
  wave_changes = change && *change <= slice;
  return wave_changes ? *change : slice;
}

void SystemcPort::on_irq() {
  sc_core::sc_pause();
}

void SystemcPort::begin_step(std::uint64_t step) {
  if (wave_) wave_->begin_step(step);
}

// The run ended in this very instant, which SystemC traces only when time moves on: let the bus, which has
// read the outputs back since then, have its time first.
void SystemcPort::end_step(std::uint64_t step) {
  if (!wave_) return;
  sc_core::sc_start(delay_);
  delay_ = sc_core::SC_ZERO_TIME;
  wave_->end_step(step);
}

std::vector<SignalRange> SystemcPort::inner_ranges() const {
  return levels::inner_ranges(device_.cells.array(), device_.cells.topology(), device_.cells.extremes);
}

} // namespace hopmesh::levels
