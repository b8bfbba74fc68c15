// A VCD wave of the engine, for a window of steps or cycles and some of its cells. Outside the window the
// engine computes runs; inside, the clock-stepped one does too.
#pragma once

#include "sim/engine/engine.h"
#include "sim/levels/waves/clocked_vcd.h"

#include <memory>
#include <optional>

namespace hopmesh::levels {

/// What a run is started with.
struct RunLimits {
  std::uint32_t threshold = 0, max_sweeps = 1;
  spec::StopRule rule = {};
};

/// Keeps time in cycles of the array's clock, as the SystemC level does: the host's writes show when the last
/// run was read back, transfers take their bus cycles one after the other, and START takes effect when the
/// bus has delivered it.
class EngineWave {
 public:
  /// Throws input::InputError for a cell that the array does not have.
  EngineWave(WaveRequest request, const spec::ArraySpec& array, const spec::Topology& topology);
  ~EngineWave();
  EngineWave(const EngineWave&) = delete;
  EngineWave& operator=(const EngineWave&) = delete;

  void begin_step(std::uint64_t step);
  /// `bus`, here and below: cycles that the bus was held for so far.
  void end_step(std::uint64_t step, std::uint64_t bus);
  /// The run that `array` is about to compute, clock by clock if the window asks for it. Ends early on
  /// `stop`.
  void run(const engine::Engine& array, const RunLimits& limits, std::uint64_t bus,
           const std::atomic<bool>& stop);
  /// `array` has computed it. Throws std::logic_error if that was not the same; a run that was aborted ends
  /// the wave, which has shown more than it came to.
  void ran(const engine::Engine& array, bool aborted);
  void irq(bool level, std::uint64_t bus);
  /// After the last step.
  void finish();
  const std::string& trouble() const { return trouble_; }

 private:
  bool wants(std::uint32_t max_sweeps) const;
  void load(const engine::Engine& array);
  void advance();
  void clock();
  void open();
  void close(std::uint64_t halves);
  void guarded(const std::function<void()>& write);
  std::uint64_t cycles() const { return array_.result().cycles; } ///< of the run at hand

  const WaveRequest request_;
  const std::uint64_t period_; ///< picoseconds
  const std::unique_ptr<engine::ClockStepped> stepped_array_;
  engine::ClockStepped& array_;
  std::optional<ClockedVcd> vcd_;
  bool began_ = false, done_ = false, stepped_ = false; ///< stepped_: the run at hand is computed here, too
  bool irq_ = false;
  std::uint64_t step_ = 0, now_ = 0, bus_ = 0; ///< bus_: cycles of the bus that are a part of now_
  std::uint64_t run_began_ = 0, total_ = 0;    ///< total_: cycles of all runs before the one at hand
  std::string trouble_;
};

} // namespace hopmesh::levels
