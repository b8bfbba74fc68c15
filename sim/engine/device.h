// The engine behind the array's bus: registers, windows and interrupt line as docs/hardware/registers.md
// says, so that firmware cannot tell which level answers.
#pragma once

#include "firmware/host_bus.h"
#include "sim/engine/engine.h"

#include <array>

namespace hopmesh::engine {

/// Time passes while the host waits: a run that was started is computed by the next wait_for_irq().
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
  std::uint64_t bus_cycles() const { return bus_cycles_; } ///< that the bus was held for
  /// A register as a debugger sees it: in no time, and without a trace.
  std::uint32_t peek(std::uint32_t offset) const { return reg(offset); }
  Engine& engine() { return engine_; }
  const Engine& engine() const { return engine_; }

 private:
  enum class Memory { first_link, link, bias, output, weight };
  struct Place {
    Memory memory;
    std::size_t index, words; ///< word addressed, and how many the window has
  };

  bool find(std::uint32_t address, std::uint32_t count, Place& place) const;
  void hold_bus(std::uint32_t words);
  std::uint32_t& reg(std::uint32_t offset) { return registers_[offset / 4]; }
  std::uint32_t reg(std::uint32_t offset) const { return registers_[offset / 4]; }
  int write_register(std::uint32_t offset, std::uint32_t word);
  void control(std::uint32_t word);
  void reset();
  void finish();

  Engine engine_;
  const std::atomic<bool>& stop_;
  std::array<std::uint32_t, 64> registers_{}; ///< by offset / 4
  std::uint64_t bus_cycles_ = 0;
  bool begun_ = false;                           ///< the run at hand has been prepared
  std::uint32_t threshold_ = 0, max_sweeps_ = 1; ///< of the run at hand, as they were at START
};

} // namespace hopmesh::engine
