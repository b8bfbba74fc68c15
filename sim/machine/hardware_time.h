// How long an array takes on hardware: the clocks in which it computes, and those in which the host holds the
// bus to load it and to read it. What the host itself needs to make a step's network is not known yet and is
// in no figure here.
#pragma once

#include <cstdint>

namespace hopmesh::machine {

struct HardwareTime {
  std::uint64_t array_cycles = 0, bus_cycles = 0;

  std::uint64_t cycles() const { return array_cycles + bus_cycles; }
  double seconds(double clock_mhz) const { return static_cast<double>(cycles()) / (clock_mhz * 1e6); }
  /// The bus's part of the whole.
  double bus_share() const {
    return cycles() > 0 ? static_cast<double>(bus_cycles) / static_cast<double>(cycles()) : 0;
  }
};

} // namespace hopmesh::machine
