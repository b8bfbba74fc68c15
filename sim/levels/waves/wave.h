// A VCD wave of the SystemC array, for a window of steps or cycles and some of its cells.
#pragma once

#include "rtl_model/systemc/device.h"
#include "sim/levels/waves/wave_request.h"

#include <optional>
#include <string>

namespace hopmesh::levels {

/// Writes beside the final name and renames when closed. Walks the array by clock exactly while it is open.
class Wave {
 public:
  /// Throws input::InputError for a cell that the array does not have.
  /// `waking`: of the array outside the window.
  Wave(WaveRequest request, systemc::Device& device, const sc_core::sc_signal<bool>& irq,
       systemc::Waking waking);
  ~Wave();
  Wave(const Wave&) = delete;
  Wave& operator=(const Wave&) = delete;

  void begin_step(std::uint64_t step);
  void end_step(std::uint64_t step);
  /// How long simulation may run before the wave has to be opened or closed; the run at hand began at
  /// `began`.
  std::optional<sc_core::sc_time> next_change(sc_core::sc_time began, std::uint64_t cycles_before) const;
  void change();
  /// While the wave is open: ends it, complete up to now, when its disk is nearly full (SystemC does not
  /// look).
  void close_when_disk_full();
  bool open_now() const { return file_ != nullptr; }
  /// Why there is no whole wave, in one line; empty if all is well.
  const std::string& trouble() const { return trouble_; }

 private:
  void open();
  void close();
  void walk(systemc::CycleWindow window);

  const WaveRequest request_;
  systemc::Device& device_;
  const sc_core::sc_signal<bool>& irq_;
  const systemc::Waking waking_;
  sc_core::sc_trace_file* file_ = nullptr;
  bool began_ = false, done_ = false;
  std::string trouble_;
};

} // namespace hopmesh::levels
