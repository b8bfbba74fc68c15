// Who works when: host bus and array take turns, and within the array's cycles multipliers work or wait
// (docs/hardware/machine.md, "Time"). What the host itself needs between two runs is known where its
// instructions are counted.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"
#include "sim/machine/hardware_time.h"

namespace hopmesh::machine {

/// What was counted of a step, or of many.
struct Work {
  std::uint64_t array_cycles = 0, bus_cycles = 0, sweeps = 0;
  std::optional<double> host_seconds = {};
};

/// Where the cycles went, and what the multipliers of the accumulators did in them.
struct Timeline {
  std::uint64_t bus = 0;         ///< the host writes and reads; the array waits
  std::uint64_t prepare = 0;     ///< the array takes START and sums N
  std::uint64_t sweeps = 0;      ///< the array fires its phases and looks whether outputs rest
  std::uint64_t multipliers = 0; ///< of all accumulators
  std::uint64_t products = 0;    ///< cycles of a multiplier in which it multiplies a weight

  std::optional<double> host_seconds = {};

  HardwareTime time() const { return {prepare + sweeps, bus, host_seconds}; }
  /// Cycles of multipliers that multiply over all that there are, in the array's own cycles.
  double utilisation() const { return share(time().array_cycles); }
  /// Those cycles over all of array and bus.
  double utilisation_with_bus() const { return share(time().cycles()); }

 private:
  double share(std::uint64_t cycles) const {
    const double all = static_cast<double>(multipliers) * static_cast<double>(cycles);
    return all > 0 ? static_cast<double>(products) / all : 0;
  }
};

/// Of what was counted: a sweep takes as many cycles as the formula says and multiplies each weight once; the
/// rest of the array's cycles is what went before the sweeps.
Timeline timeline_of(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work);

/// Cycles that the driver holds the bus for a run of the array. No burst is longer than `longest_burst`
/// words.
struct RunTransfers {
  std::uint64_t load = 0; ///< STATUS, weights, biases, outputs, and four registers, the last of them START
  std::uint64_t read = 0; ///< IRQ_STATUS, four registers, outputs
};
RunTransfers run_transfers(const spec::ArraySpec& array, const spec::Topology& topology,
                           std::size_t longest_burst);

/// What a step of `runs` runs comes to that take `sweeps` sweeps together, by formula.
Work work_of(const spec::ArraySpec& array, const spec::Topology& topology, std::uint64_t runs,
             std::uint64_t sweeps, std::size_t longest_burst);

} // namespace hopmesh::machine
