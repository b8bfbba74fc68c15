// The Verilog models of the array (rtl_model/verilog/) behind one interface, clock by clock.
#pragma once

#include "tests/bench/bench_networks.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace hopmesh::bench {

/// A model simulated by Verilator. Codes are words as on the production array's bus, weights in Topology's
/// layout. Models that are not time_multiplexed have their mesh built in.
class VerilatedArray {
 public:
  VerilatedArray() = default;
  VerilatedArray(const VerilatedArray&) = delete;
  VerilatedArray& operator=(const VerilatedArray&) = delete;
  virtual ~VerilatedArray() = default;

  /// Outside a run. `start` may be loaded anew by itself.
  virtual void load(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& biases) = 0;
  virtual void load_start(const std::vector<std::int32_t>& start) = 0;

  /// A whole run, from START to DONE. A threshold counts in the state's last place.
  void run(std::uint32_t threshold_raw, std::uint32_t max_sweeps) {
    begin_run(threshold_raw, max_sweeps);
    finish_run();
  }
  /// The clock that takes START, the first of the run.
  virtual void begin_run(std::uint32_t threshold_raw, std::uint32_t max_sweeps) = 0;
  virtual void finish_run() = 0;
  virtual void step_clock() = 0;

  virtual bool busy() const = 0;
  virtual bool converged() const = 0;
  virtual std::vector<std::int32_t> outputs_raw() const = 0;
  virtual std::uint32_t sweeps() const = 0;
  virtual std::uint64_t cycles() const = 0;
  virtual std::uint32_t largest_change_raw() const = 0;
};

} // namespace hopmesh::bench
