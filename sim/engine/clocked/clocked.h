// The array clock by clock: every register of every neuron stands in memory after every clock, as the
// hardware has it. docs/hardware/engine.md, "Clock by clock".
#pragma once

#include "sim/engine/clocked/clocked_beats.h"
#include "sim/engine/engine.h"

namespace hopmesh::engine {

class ClockedEngine {
 public:
  /// The array must have passed spec::validate for the topology.
  ClockedEngine(const spec::ArraySpec& array, const spec::Topology& topology);
  ClockedEngine(const ClockedEngine&) = delete;
  ClockedEngine& operator=(const ClockedEngine&) = delete;

  // Memories as words on the bus, as Engine takes them; outside a run.
  void write_weights(std::size_t first, const std::uint32_t* words, std::size_t count);
  void write_biases(std::size_t first, const std::uint32_t* words, std::size_t count);
  void write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count);

  /// START: cycle 0 is the one that now begins.
  void start(std::uint32_t threshold, std::uint32_t max_sweeps);
  /// Goes one clock on; does nothing when idle.
  void step();
  /// Goes `clocks` clocks on, or to the end of the run where that comes before. Registers hold what they hold
  /// after the last of these clocks; values that nobody can see in between are left out.
  void step(std::uint64_t clocks);

  /// Segment (a number of spec::Segment) and beat of the cycle that comes next.
  int segment() const { return segment_; }
  std::uint64_t beat() const { return beat_; }
  bool busy() const { return segment_ != spec::Segment::idle; }
  bool done() const { return done_; }
  /// The run up to now: complete sweeps, the largest change of the last one, cycles of the clock.
  const spec::Relaxation& result() const { return result_; }
  const spec::CycleModel& cycles() const { return cycles_; }
  const spec::Formats& formats() const { return plan_.formats; } ///< with the accumulator as built
  const spec::Phases& phases() const { return phases_; }
  const spec::Topology& topology() const { return topology_; }

  // Registers of a neuron, raw codes, as they stand after the last clock.
  std::int64_t norm(std::size_t neuron) const { return beats_.at.norm[row_[neuron]]; }
  std::int64_t reciprocal(std::size_t neuron) const { return beats_.at.reciprocal[row_[neuron]]; }
  std::int64_t sum(std::size_t neuron) const { return beats_.at.sum[row_[neuron]]; }
  std::int64_t drive(std::size_t neuron) const { return beats_.at.drive[row_[neuron]]; }
  std::int64_t change(std::size_t neuron) const { return beats_.at.change[row_[neuron]]; } ///< Delta V
  std::int32_t state(std::size_t neuron) const { return beats_.at.state[row_[neuron]]; }
  std::int32_t link(std::size_t neuron) const { return beats_.at.link[row_[neuron]]; }

  /// All registers at once, by row; row(neuron) says where a neuron's are.
  const ClockedRegisters& registers() const { return beats_.at; }
  std::size_t row(std::size_t neuron) const { return row_[neuron]; }

 private:
  /// Who fires in a phase: neurons [first_p, last_p) of a bank's cells.
  struct Firing {
    std::size_t bank, first_p, last_p;
  };
  void do_beats(std::uint64_t first, std::uint64_t last);
  void do_prepare(std::uint64_t first, std::uint64_t last);
  void do_phase(std::uint64_t first, std::uint64_t last);
  void enter(int segment);
  void leave_segment();

  const spec::Topology topology_;
  const spec::Phases phases_;
  const spec::CycleModel cycles_;
  const NeuronPlan plan_;
  const ClockedLayout layout_;
  const std::uint64_t normalise_cycles_;
  ClockedBeats beats_;
  std::vector<std::uint32_t> row_; ///< of each neuron
  int segment_ = spec::Segment::idle;
  std::uint64_t beat_ = 0, length_ = 0; ///< clocks of the segment that are over, and all of them
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
  bool done_ = false;
  std::uint32_t threshold_ = 0, max_sweeps_ = 1;
  std::int64_t largest_ = 0; ///< |Delta V| of this sweep so far, as the convergence detector has it
  spec::Relaxation result_;
};

} // namespace hopmesh::engine
