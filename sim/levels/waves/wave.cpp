#include "sim/levels/waves/wave.h"

#include <filesystem>
#include <sysc/tracing/sc_tracing_ids.h>

namespace hopmesh::levels {

Wave::Wave(WaveRequest request, systemc::Device& device, const sc_core::sc_signal<bool>& irq,
           systemc::Waking waking)
    : request_(std::move(request)), device_(device), irq_(irq), waking_(waking) {
  check_wave(request_, device.cells.topology().cells());
  if (request_.in_cycles) walk({request_.first, request_.last});
}

Wave::~Wave() {
  if (file_) close();
  if (began_ && !done_) warn_empty_window(request_);
}

void Wave::open() {
  // SystemC would tell stdout, where results go, which unit of time was set.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_TRACING_TIMESCALE_UNIT_, sc_core::SC_DO_NOTHING);
  file_ = sc_core::sc_create_vcd_trace_file((request_.file + ".part").c_str());
  const bool whole = device_.cells.period().value() % 2000 == 0; // half a cycle is so many nanoseconds
  file_->set_time_unit(1, whole ? sc_core::SC_NS : sc_core::SC_PS);
  sc_core::sc_trace(file_, irq_, std::string(device_.name()) + ".irq");
  device_.cells.sequencer.trace(file_);
  std::vector<std::size_t> cells = request_.cells;
  for (std::size_t c = 0; request_.cells.empty() && c < device_.cells.topology().cells(); ++c)
    cells.push_back(c);
  device_.cells.trace_cells(file_, cells);
}

void Wave::close() {
  sc_core::sc_close_vcd_trace_file(file_);
  file_ = nullptr;
  done_ = true;
  const std::string part = request_.file + ".part.vcd"; // SystemC adds the ending
  std::error_code error;
  std::filesystem::rename(part, request_.file, error);
  if (error) trouble_ = request_.file + ": " + error.message();
}

// An array that is woken by every clock anyway stays so.
void Wave::walk(systemc::CycleWindow window) {
  if (waking_ == systemc::Waking::by_phase) device_.walk(window);
}

void Wave::close_when_disk_full() {
  if (!file_ || !disk_nearly_full(request_)) return;
  walk({});
  close();
  trouble_ = early_end_text(request_);
}

void Wave::begin_step(std::uint64_t step) {
  began_ = true;
  if (request_.in_cycles || file_ || done_ || step < request_.first || step >= request_.last) return;
  open();
  walk({device_.cells.sequencer.total_cycles(), UINT64_MAX});
}

void Wave::end_step(std::uint64_t step) {
  if (!file_) return;
  if (request_.in_cycles ? device_.cells.sequencer.total_cycles() < request_.last : step + 1 < request_.last)
    return;
  walk({});
  close();
}

std::optional<sc_core::sc_time> Wave::next_change(sc_core::sc_time began, std::uint64_t cycles_before) const {
  if (!request_.in_cycles || done_) return std::nullopt;
  const std::uint64_t cycle = std::max(file_ ? request_.last : request_.first, cycles_before);
  if (cycle == UINT64_MAX) return std::nullopt;
  // Half-way between two edges: an edge belongs to the cycle that it ends.
  const auto at = began + device_.cells.period() * (static_cast<double>(cycle - cycles_before) + 0.5);
  const auto now = sc_core::sc_time_stamp();
  return at > now ? at - now : sc_core::SC_ZERO_TIME;
}

void Wave::change() {
  if (file_)
    close();
  else
    open();
}

} // namespace hopmesh::levels
