// The engine behind the array's bus: registers, windows and interrupt line as docs/hardware/registers.md
// says, so that firmware cannot tell which level answers.
#pragma once

#include "firmware/host_bus.h"
#include "rtl_model/spec/memory_map.h"
#include "sim/engine/engine.h"

#include <array>

namespace hopmesh::engine {

/// Time passes while the bus is held and while the host waits. A run is computed when somebody looks: by the
/// next wait_for_irq() to its end, by a transfer as far as it has come by then.
class Device : public HostBus {
 public:
  /// `stop` ends a wait between two sweeps (HM_ERROR_STOPPED); the run goes on with the next one.
  Device(const spec::ArraySpec& array, const spec::Topology& topology, const Options& options,
         const std::atomic<bool>& stop);

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override;

  bool irq() const;
  bool busy() const;
  bool running() const { return running_; } ///< a run is at hand, be it behind a RESET
  std::uint64_t held() const {
    return held_;
  } ///< cycles that the bus was held for, since the device was made
  /// A register as the last transfer left it: in no time, and without a trace.
  std::uint32_t peek(std::uint32_t offset) const { return reg(offset); }
  // Of the run at hand, as they were at START:
  std::uint32_t threshold() const { return threshold_; }
  std::uint32_t max_sweeps() const { return max_sweeps_; }
  const spec::StopRule& stop_rule() const { return stop_rule_; }
  Engine& engine() { return engine_; }
  const Engine& engine() const { return engine_; }

 private:
  /// Where a transfer of so many words leads: a register, or words of a window. Nowhere: not there.
  struct Place {
    bool there = false;
    const spec::MemoryWindow* window = nullptr;
    spec::Window which{};
    std::uint64_t index = 0;
  };

  Place find(std::uint32_t address, std::uint32_t count) const;
  void hold_bus(std::uint64_t cycles);
  int refuse();
  std::uint32_t& reg(std::uint32_t offset) { return registers_[offset / 4]; }
  std::uint32_t reg(std::uint32_t offset) const { return registers_[offset / 4]; }
  std::uint32_t read_register(std::uint32_t offset);
  void write_register(std::uint32_t offset, std::uint32_t word);
  void read_window(const Place& place, std::uint32_t* words, std::uint32_t count);
  void write_window(const Place& place, const std::uint32_t* words, std::uint32_t count);
  void read_codes(spec::Window window, std::uint64_t first, std::uint32_t* words, std::uint64_t count) const;
  void write_codes(spec::Window window, std::uint64_t first, const std::uint32_t* words, std::uint64_t count);

  bool resets(std::uint64_t cycle) const { return cycle < reset_until_; }
  std::uint64_t sweeps_by(std::uint64_t cycle) const;
  void control(std::uint32_t word, std::uint64_t asked_at);
  void abort(std::uint64_t at);
  void reset();
  void reset_registers();
  void start();
  void catch_up();
  void run_to(std::uint64_t sweeps, const std::atomic<bool>& stop);
  void finish();

  Engine engine_;
  const spec::MemoryMap map_;
  const std::atomic<bool>& stop_;
  std::array<std::uint32_t, 64> registers_{}; ///< by offset / 4
  std::vector<std::uint32_t> codes_;          ///< of packed words on their way
  std::uint64_t held_ = 0, held_at_reset_ = 0;
  std::uint64_t run_cycles_ = 0, largest_sum_ = 0; ///< of the last run
  std::uint64_t now_ = 0;                          ///< cycle in which the next transfer begins
  std::uint64_t reset_until_ = 0, run_from_ = 0;   ///< cycles; run_from_: in which START is taken
  bool running_ = false;
  bool begun_ = false; ///< and has been prepared
  bool aborted_ = false;
  std::uint32_t threshold_ = 0, max_sweeps_ = 1;
  spec::StopRule stop_rule_;
  std::uint32_t last_sweep_ = 1; ///< at which it ends if it does not converge
};

} // namespace hopmesh::engine
