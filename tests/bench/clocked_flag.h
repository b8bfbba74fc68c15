// flag-400's network on the clock-stepped engine: what is compared, clock for clock, with other models of the
// same array.
#pragma once

#include "sim/engine/clocked/clocked.h"
#include "sim/levels/waves/clocked_vcd.h"
#include "tests/bench/grid_network.h"

#include <memory>

namespace hopmesh::bench {

/// Every register of every neuron, as somebody who looks at all of them copies them.
struct RegisterCopy {
  std::vector<std::int64_t> norm, sum, drive, change;
  std::vector<std::int32_t> state, link;

  void take(const engine::ClockedEngine& engine);
};

class ClockedFlag {
 public:
  ClockedFlag();

  /// Steps `clocks` clocks, one at a time; a run that ends begins again. Returns the sum of all outputs,
  /// which hangs on every one of them.
  std::int64_t step(std::uint64_t clocks);
  /// Steps, and copies all registers out after each clock.
  std::int64_t step_and_copy(std::uint64_t clocks);
  /// Steps, and draws a wave of every register (thrown away: the disk is no part of this).
  std::int64_t step_and_draw(std::uint64_t clocks);
  /// Steps those clocks, of which only the last shows.
  std::int64_t stride(std::uint64_t clocks);

  engine::ClockedEngine& engine() { return *engine_; }

 private:
  void start_if_idle();
  std::int64_t outputs() const;

  const GridNetwork network_;
  std::unique_ptr<engine::ClockedEngine> engine_;
  RegisterCopy copy_;
};

} // namespace hopmesh::bench
