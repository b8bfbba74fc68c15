// The array clock by clock: every register of every neuron stands in memory after every clock, as the
// hardware has it. docs/hardware/engine.md, "Clock by clock".
#pragma once

#include "sim/engine/clocked/clock_stepped.h"
#include "sim/engine/clocked/clocked_beats.h"

namespace hopmesh::engine {

/// An array that is not folded.
class ClockedEngine final : public ClockStepped {
 public:
  /// The array must have passed spec::validate for the topology.
  ClockedEngine(const spec::ArraySpec& array, const spec::Topology& topology);

  void write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) override;
  void write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) override;
  void write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) override;

  using ClockStepped::step;
  void step() override;
  std::vector<Probe> probes(const std::vector<std::size_t>& cells) const override;

  // Registers of a neuron, raw codes, as they stand after the last clock.
  std::int64_t norm(std::size_t neuron) const { return beats_.at.norm[row_[neuron]]; }
  std::int64_t reciprocal(std::size_t neuron) const { return beats_.at.reciprocal[row_[neuron]]; }
  std::int64_t sum(std::size_t neuron) const { return beats_.at.sum[row_[neuron]]; }
  std::int64_t drive(std::size_t neuron) const { return beats_.at.drive[row_[neuron]]; }
  std::int64_t change(std::size_t neuron) const { return beats_.at.change[row_[neuron]]; } ///< Delta V
  std::int32_t state(std::size_t neuron) const override { return beats_.at.state[row_[neuron]]; }
  std::int32_t link(std::size_t neuron) const { return beats_.at.link[row_[neuron]]; }
  /// Y, of a momentum array.
  std::int32_t extrapolated(std::size_t neuron) const { return beats_.at.extrapolated[row_[neuron]]; }

  /// All registers at once, by row; row(neuron) says where a neuron's are.
  const ClockedRegisters& registers() const { return beats_.at; }
  std::size_t row(std::size_t neuron) const { return row_[neuron]; }

 private:
  /// Who fires in a phase: neurons [first_p, last_p) of a bank's cells.
  struct Firing {
    std::size_t bank, first_p, last_p;
  };
  void do_beats(std::uint64_t first, std::uint64_t last) override;
  void entered() override;
  void restart() override { beats_.restart(); }
  void do_prepare(std::uint64_t first, std::uint64_t last);
  void do_phase(std::uint64_t first, std::uint64_t last);

  const ClockedLayout layout_;
  const std::uint64_t drive_cycles_, change_cycles_;
  ClockedBeats beats_;
  std::vector<std::uint32_t> row_; ///< of each neuron
  Firing firing_{0, 0, 0};
  /// What step() needs in a phase whose clocks each add one tap to one stretch of rows; `beat` is null
  /// elsewhere.
  struct Plain {
    const ClockedBeat* beat = nullptr;
    ClockedBeats::TapAdder add = nullptr;
    const std::int32_t *weights = nullptr, *inputs = nullptr;
    std::int64_t* sums = nullptr;
    std::size_t row = 0, weight_stride = 0, input_stride = 0;
  } plain_;
};

} // namespace hopmesh::engine
