// An array behind its bus as C++ code asks it: load it, run it whole or sweep by sweep, read everything back.
#pragma once

#include "firmware/bus.h"
#include "rtl_model/spec/relaxation.h"
#include "rtl_model/spec/topology.h"
#include "sim/levels/codes.h"

namespace hopmesh::levels {

/// Bus and topology must outlive it. Everything throws as check() of bus_error.h does.
class BusArray {
 public:
  BusArray(const hm_bus& bus, const spec::Topology& topology) : bus_(bus), topology_(topology) {}

  void load(const Codes& weights, const Codes& biases, const Codes& outputs) const;
  void put_outputs(const Codes& codes) const;
  /// From where V is, until at rest or `max_sweeps`.
  spec::Relaxation run(std::uint32_t threshold, std::uint32_t max_sweeps) const;
  /// By a rule of STOP. That of a run without one is what the array has: none after RESET.
  spec::Relaxation run(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule) const;
  spec::Relaxation one_sweep() const { return run(0, 1); }
  /// What the registers tell of the last run, and what it was started with.
  spec::Relaxation last_run() const;
  std::uint32_t threshold() const;
  std::uint32_t max_sweeps() const;
  spec::StopRule stop_rule() const;

  Codes weights() const;
  Codes biases() const;
  Codes outputs() const;
  /// The table of m, of an array that has one.
  void put_momentum(const Codes& codes) const;
  Codes momentum(std::size_t entries) const;
  /// Every capability register, in the order of their addresses.
  std::vector<std::uint32_t> capabilities() const;
  /// Cycles in which the host has held the bus until now.
  std::uint64_t bus_cycles() const;

 private:
  std::uint32_t read(std::uint32_t address) const;
  /// A register of two words; `low` is the address of the lower one.
  std::uint64_t read_wide(std::uint32_t low) const;
  void write(std::uint32_t address, std::uint32_t word) const;
  /// A window, as the capability registers tell it.
  struct Window {
    std::uint32_t base;
    int codes_a_word;
  };
  Window weight_window() const;
  Window bias_window() const;
  Window output_window() const;
  Window momentum_window() const;
  Codes read_window(const Window& window, std::size_t codes) const;
  void write_window(const Window& window, const Codes& codes) const;

  const hm_bus& bus_;
  const spec::Topology& topology_;
};

} // namespace hopmesh::levels
