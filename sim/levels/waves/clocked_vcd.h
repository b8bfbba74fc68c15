// The VCD of a clock-stepped array: the signals of the SystemC array's wave under the same names, so that
// what somebody saved for a viewer fits both.
#pragma once

#include "rtl_model/spec/signals.h"
#include "sim/engine/clocked/clock_stepped.h"
#include "sim/files/vcd.h"
#include "sim/levels/waves/wave_request.h"

namespace hopmesh::levels {

/// Times are in half cycles of the array's clock.
class ClockedVcd {
 public:
  /// `irq`: of the array now.
  ClockedVcd(const WaveRequest& request, const engine::ClockStepped& array, std::uint64_t period, bool irq);

  /// What the host wrote, and that the array is busy.
  void show_host(std::uint64_t halves);
  /// Everything, as it stands in the middle of a run.
  void show_all(std::uint64_t halves);
  /// The sequencer's registers: the first cycle of a run begins.
  void show_start(std::uint64_t halves);
  /// A rising edge; `segment` is that of the cycle that it ends, `asleep` that nobody walks the next one.
  void edge(std::uint64_t halves, int segment, bool asleep);
  void irq(std::uint64_t halves, bool level);
  /// Time up to here has passed.
  void pass(std::uint64_t halves);
  void finish(std::uint64_t halves);

 private:
  struct Watched {
    const engine::Probe* probe;
    std::size_t signal;
  };

  std::size_t add(const spec::Signal& signal);
  void show_counters();
  void add_probes();
  void add_sequencer();
  void at(std::uint64_t halves);
  void show_sequencer(bool asleep);
  void show(const std::vector<Watched>& watched);

  const engine::ClockStepped& array_;
  const std::uint64_t period_;
  files::VcdFile file_;
  std::size_t irq_ = 0, clock_ = 0, segment_ = 0, beat_ = 0, busy_ = 0, sweeps_ = 0, momentum_ = 0;
  const std::vector<engine::Probe> probes_;
  std::vector<Watched> always_, of_prepare_; ///< what changes in every segment, and in prepare
  std::vector<std::vector<Watched>> of_phase_;
  std::uint64_t falls_ = 0, time_ = 0; ///< when the clock that is high falls; the last time shown
  bool high_ = false;
};

} // namespace hopmesh::levels
