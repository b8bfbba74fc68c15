// How long a step or a motion takes on hardware: the clocks in which the array computes, those in which the
// bus is held to load it and to read it, and the time in which the host makes networks and moves the mesh,
// where that is known: instructions of an emulated host at its clock. The three take turns.
#pragma once

#include <cstdint>
#include <optional>

namespace hopmesh::machine {

struct HardwareTime {
  std::uint64_t array_cycles = 0, bus_cycles = 0;
  std::optional<double> host_seconds = {}; ///< none: nobody counted

  std::uint64_t cycles() const { return array_cycles + bus_cycles; }
  double seconds(double clock_mhz) const {
    return static_cast<double>(cycles()) / (clock_mhz * 1e6) + host_seconds.value_or(0);
  }
  /// The bus's part of array and bus.
  double bus_share() const {
    return cycles() > 0 ? static_cast<double>(bus_cycles) / static_cast<double>(cycles()) : 0;
  }
  /// The host's part of all; 0 where nobody counted.
  double host_share(double clock_mhz) const {
    return seconds(clock_mhz) > 0 ? host_seconds.value_or(0) / seconds(clock_mhz) : 0;
  }
};

} // namespace hopmesh::machine
